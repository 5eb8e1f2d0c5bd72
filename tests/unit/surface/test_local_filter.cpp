// What a detail of the local filter moves.
#include "surface/local_filter.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <vector>

#include "surface_shapes.h"

namespace zerotree::test {
namespace {

using surface::Positions;
using surface::SubdivisionHierarchy;
using surface::SubdivisionLevel;

struct Weights {
  float dip, lift;
};

/// Of the edge between `vertex` and `other`, at `vertex`.
Weights weights_at(const SubdivisionLevel& level, std::uint32_t vertex, std::uint32_t other) {
  for (std::size_t edge = 0; edge < level.edge_count; ++edge)
    for (std::size_t end = 0; end < 2; ++end) {
      const auto& ends = level.edges.vertices[edge];
      if (ends[end] == vertex && ends[1 - end] == other)
        return {level.local_details.dips[edge][end], level.local_details.lifts[edge][end]};
    }
  ADD_FAILURE() << "no edge between " << vertex << " and " << other;
  return {};
}

void expect_weights(const Weights& weights, float dip, float lift) {
  EXPECT_FLOAT_EQ(weights.dip, dip);
  EXPECT_FLOAT_EQ(weights.lift, lift);
}

/// The vertices that a detail moves, by how much.
std::map<std::uint32_t, float> column(const SubdivisionLevel& level, std::size_t edge) {
  surface::Moves moves(3 * std::size_t{level.edge_count}, 0.0f);
  moves[3 * edge] = 1.0f;
  Positions fine(3 * (std::size_t{level.vertex_count} + level.edge_count), 0.0f);
  surface::add_details(level, moves, fine);
  std::map<std::uint32_t, float> moved;
  for (std::uint32_t v = 0; v < fine.size() / 3; ++v)
    if (fine[3 * v] != 0.0f) moved[v] = fine[3 * v];
  return moved;
}

/// A lattice of 7 x 7 vertices with a crease of two edges inside and a tagged vertex.
SubdivisionHierarchy tagged_lattice(int levels) {
  return {topology_of({"lattice", grid(6, 6), {{24, 25}, {25, 26}}, {16}}), levels, kLocal};
}

TEST(LocalFilter, HasItsWeightsOnTheRegularLattice) {
  const SubdivisionHierarchy hierarchy = tagged_lattice(1);
  expect_weights(weights_at(hierarchy.level(0), 32, 33), 0.30f, 0.05f);
  expect_weights(weights_at(hierarchy.level(0), 32, 40), 0.30f, 0.05f);
}

TEST(LocalFilter, SharesThemOutAmongTheEdgesAtAVertex) {
  const SubdivisionHierarchy three(topology_of({"", tetrahedron(), {}, {}}), 1, kLocal);
  expect_weights(weights_at(three.level(0), 0, 1), 0.60f, 0.10f);
  const TriangleMesh poles = bipyramid(12);
  const SubdivisionHierarchy twelve(topology_of({"", poles, {}, {}}), 1, kLocal);
  for (std::size_t edge = 0; edge < twelve.level(0).edge_count; ++edge) {
    const auto& filter = twelve.level(0).local_details;
    for (std::size_t end = 0; end < 2; ++end) {
      const bool is_pole = poles.positions[twelve.level(0).edges.vertices[edge][end]].z() != 0.0;
      EXPECT_FLOAT_EQ(filter.dips[edge][end], is_pole ? 0.15f : 0.45f);
      EXPECT_FLOAT_EQ(filter.lifts[edge][end], is_pole ? 0.025f : 0.075f);
    }
  }
}

TEST(LocalFilter, HasItsOwnWeightsAlongCurves) {
  const SubdivisionHierarchy hierarchy = tagged_lattice(1);
  const SubdivisionLevel& level = hierarchy.level(0);
  expect_weights(weights_at(level, 3, 4), 0.30f, 0.10f);    // along the boundary
  expect_weights(weights_at(level, 3, 10), 0.0f, 0.0f);     // away from it
  expect_weights(weights_at(level, 10, 3), 0.30f, 0.05f);   // and towards it
  expect_weights(weights_at(level, 25, 24), 0.30f, 0.10f);  // along the crease
  expect_weights(weights_at(level, 25, 32), 0.0f, 0.0f);
}

TEST(LocalFilter, LeavesCornersAlone) {
  const SubdivisionHierarchy hierarchy = tagged_lattice(1);
  const SubdivisionLevel& level = hierarchy.level(0);
  expect_weights(weights_at(level, 16, 17), 0.0f, 0.0f);  // tagged
  expect_weights(weights_at(level, 17, 16), 0.30f, 0.05f);
  expect_weights(weights_at(level, 6, 5), 0.0f, 0.0f);  // a single triangle at the boundary
  expect_weights(weights_at(level, 5, 6), 0.30f, 0.10f);
}

TEST(LocalFilter, TakesADartForAPlaceInTheSurface) {
  const SubdivisionHierarchy hierarchy = tagged_lattice(1);
  expect_weights(weights_at(hierarchy.level(0), 24, 25), 0.30f, 0.05f);
  expect_weights(weights_at(hierarchy.level(0), 24, 23), 0.30f, 0.05f);
}

/// The vertices of the level below on the boundary.
std::set<std::uint32_t> boundary_vertices(const SubdivisionLevel& fine) {
  std::set<std::uint32_t> vertices;
  for (std::size_t edge = 0; edge < fine.edge_count; ++edge)
    if (fine.edges.wings[edge][2] == bitstream::kNone)
      vertices.insert(fine.edges.vertices[edge].begin(), fine.edges.vertices[edge].end());
  return vertices;
}

// Subdivision of a curve asks the curve alone, so what does not move it at once never does.
TEST(LocalFilter, DoesNotMoveTheBoundaryFromBesideIt) {
  const SubdivisionHierarchy hierarchy(topology_of({"", grid(4, 3), {}, {}}), 3, kLocal);
  for (int number = 0; number < 2; ++number) {
    const SubdivisionLevel& level = hierarchy.level(number);
    const std::set<std::uint32_t> boundary = boundary_vertices(hierarchy.level(number + 1));
    for (std::size_t edge = 0; edge < level.edge_count; ++edge) {
      if (level.edges.wings[edge][2] == bitstream::kNone) continue;
      for (const auto& [vertex, move] : column(level, edge)) EXPECT_FALSE(boundary.count(vertex));
    }
  }
}

TEST(LocalFilter, HasZeroMeanAlongACurve) {
  const SubdivisionHierarchy hierarchy = tagged_lattice(2);
  const SubdivisionLevel& level = hierarchy.level(0);
  const std::set<std::uint32_t> boundary = boundary_vertices(hierarchy.level(1));
  for (std::size_t edge = 0; edge < level.edge_count; ++edge) {
    if (level.edges.vertices[edge] != std::array<std::uint32_t, 2>{2, 3}) continue;
    float sum = 0.0f;
    for (const auto& [vertex, move] : column(level, edge)) sum += boundary.count(vertex) ? move : 0;
    EXPECT_NEAR(sum, 0.0f, 1e-6f);
    return;
  }
  FAIL() << "no such edge";
}

// A detail inside a face of the cube moves the inside of that face alone, one of a crease its
// crease and, through the coarse points it lifts, the insides of the two faces beside it.
TEST(LocalFilter, DoesNotReachAcrossCreases) {
  const Shape cube = base_shapes()[2];
  ASSERT_EQ(cube.name, "cube");
  const SubdivisionHierarchy hierarchy(topology_of(cube), 3, kLocal);
  std::vector<Eigen::Vector3d> flat = cube.mesh.positions;
  for (int number = 0; number < 3; ++number) {
    const SubdivisionLevel& level = hierarchy.level(number);
    append_midpoints(level, flat);
    for (std::size_t edge = 0; edge < level.edge_count; ++edge) {
      const unsigned own = cube_planes(flat[level.vertex_count + edge]);
      for (const auto& [vertex, move] : column(level, edge)) {
        const unsigned planes = cube_planes(flat[vertex]);
        EXPECT_NE(planes, 0u);
        EXPECT_EQ(planes & ~own, 0u);
      }
    }
  }
}

}  // namespace
}  // namespace zerotree::test
