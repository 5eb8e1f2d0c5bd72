// From integers to control points.
#include "surface/surface_synthesis.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <tuple>

#include "surface/detail_weights.h"
#include "surface/edge_frames.h"
#include "surface_shapes.h"

namespace zerotree::test {
namespace {

using surface::Positions;
using surface::SubdivisionHierarchy;

bitstream::CoefficientSet empty_coefficients(const SubdivisionHierarchy& hierarchy, int levels) {
  bitstream::CoefficientSet set;
  set.base_edge_count = hierarchy.base_edges().size();
  set.levels = levels;
  for (auto& channel : set.channels)
    channel.assign(bitstream::level_offset(set.base_edge_count, levels), 0);
  return set;
}

TEST(DetailWeights, GiveTheLengthTheFormatNames) {
  const surface::Dequantisation dequantisation{0.5f, 4.0f};
  EXPECT_FLOAT_EQ(detail_unit(dequantisation, 5, 4, bitstream::kNormal), 0.5f);
  EXPECT_FLOAT_EQ(detail_unit(dequantisation, 5, 4, bitstream::kTangent2), 2.0f);
  EXPECT_FLOAT_EQ(detail_unit(dequantisation, 5, 2, bitstream::kNormal), 0.5f / 4.0f);
  EXPECT_FLOAT_EQ(surface::basis_norm(0), 1.0f);
  EXPECT_FLOAT_EQ(surface::basis_norm(8), 256.0f);
}

TEST(DetailWeights, AreTheRootOfTheAreaAndHeld) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinite = std::numeric_limits<double>::infinity();
  EXPECT_FLOAT_EQ(surface::area_weight(3.0, 3.0), 1.0f);
  EXPECT_FLOAT_EQ(surface::area_weight(6.0, 3.0), std::sqrt(1.8f));
  EXPECT_FLOAT_EQ(surface::area_weight(1.0, 1e9), std::sqrt(0.2f));
  EXPECT_FLOAT_EQ(surface::area_weight(1e5, 1.0), 16.0f);
  EXPECT_FLOAT_EQ(surface::area_weight(0.0, 1.0), std::sqrt(0.2f));
  EXPECT_FLOAT_EQ(surface::area_weight(1.0, 0.0), 16.0f);
  EXPECT_FLOAT_EQ(surface::area_weight(0.0, 0.0), 1.0f);
  EXPECT_FLOAT_EQ(surface::area_weight(infinite, infinite), 1.0f);
  EXPECT_FLOAT_EQ(surface::area_weight(nan, 1.0), 1.0f);
}

surface::EdgeTangents tangents_at(const surface::SubdivisionLevel& level,
                                  const Positions& predicted, std::uint32_t edge) {
  return surface::edge_tangents(predicted.data(), level.vertex_count, level.edges.vertices[edge],
                                level.edges.wings[edge]);
}

// On a plane lattice an affine map shows in each edge's area by its determinant, at boundaries and
// creases as elsewhere.
TEST(DetailWeights, OfAnAffineLatticeFollowItsTriangles) {
  TriangleMesh lattice = grid(6, 6);
  for (Eigen::Vector3d& p : lattice.positions) p = {3.0 * p.x() + p.y(), 2.0 * p.y(), p.x()};
  const double area = 0.5 * Eigen::Vector3d(3, 0, 1).cross(Eigen::Vector3d(1, 2, 0)).norm();
  const bitstream::BaseTopology topology =
      topology_of({"lattice", lattice, {{24, 25}, {25, 26}}, {}});
  const SubdivisionHierarchy hierarchy(topology, 1, kLocal);
  const Positions base = positions_of(lattice);
  EXPECT_NEAR(surface::mean_face_area(topology, base), area, 1e-6);
  const auto& level = hierarchy.level(0);
  const Positions predicted = surface::subdivide(level, base);
  for (std::uint32_t edge = 0; edge < level.edge_count; ++edge) {
    const auto [tail, head] = level.edges.vertices[edge];
    // The boundary curve cuts these two corners.
    if (tail == 0 || head == 0 || tail == 48 || head == 48) continue;
    EXPECT_NEAR(tangents_at(level, predicted, edge).triangle_area(), area, 1e-5);
  }
}

// Triangles are compared with those of their own level.
TEST(DetailWeights, OfAPlaneLatticeAreOneAtEachLevel) {
  const TriangleMesh lattice = grid(6, 6);
  const SubdivisionHierarchy hierarchy(topology_of({"lattice", lattice, {}, {}}), 3, kLocal);
  const auto& edges = hierarchy.base_edges();
  const auto middle = static_cast<std::size_t>(
      std::find_if(edges.begin(), edges.end(),
                   [](const auto& edge) {
                     return edge.vertices == std::array<std::uint32_t, 2>{25, 24};
                   }) -
      edges.begin());
  ASSERT_LT(middle, edges.size());
  const Positions base = positions_of(lattice);
  for (int number = 0; number < 3; ++number) {
    const auto& level = hierarchy.level(number);
    auto coefficients = empty_coefficients(hierarchy, 3);
    const std::size_t cell = middle << (2 * number);
    coefficients
        .channels[bitstream::kNormal][bitstream::level_offset(edges.size(), number) + cell] = 2;
    const Positions moved = reconstruct(hierarchy, base, coefficients, {0.5f, 4.0f}, number + 1);
    const float height = moved[3 * (level.vertex_count + level.edges.cell_to_edge[cell]) + 2];
    // Both ends' lifts take 3/8 of 0.05 each; two levels above the finest the norm is 4.
    EXPECT_NEAR(std::abs(height), std::ldexp(0.5 * (1.0 - 0.0375), number - 2), 1e-6);
  }
}

class Synthesis : public testing::TestWithParam<std::tuple<Shape, surface::WaveletTransform>> {
 protected:
  const Shape& shape() const { return std::get<0>(GetParam()); }
  surface::WaveletTransform transform() const { return std::get<1>(GetParam()); }
};

TEST_P(Synthesis, WithoutDetailsIsLoop) {
  const SubdivisionHierarchy hierarchy(topology_of(shape()), 3, transform());
  const Positions base = positions_of(shape().mesh);
  EXPECT_EQ(reconstruct(hierarchy, base, empty_coefficients(hierarchy, 3), {}, 3),
            subdivided(hierarchy, base, 3));
}

// Levels above the asked one do not matter; a level beyond the coefficients' is subdivided on.
TEST_P(Synthesis, StopsAtTheLevelAsked) {
  const SubdivisionHierarchy shallow(topology_of(shape()), 2, transform());
  const SubdivisionHierarchy deep(topology_of(shape()), 4, transform());
  const Positions base = positions_of(shape().mesh);
  auto coefficients = empty_coefficients(deep, 3);
  std::mt19937 random(7);
  for (auto& channel : coefficients.channels)
    for (auto& value : channel) value = static_cast<int>(random() % 9) - 4;
  const surface::Dequantisation dequantisation{0.01f, 4.0f};
  const Positions two = reconstruct(shallow, base, coefficients, dequantisation, 2);
  EXPECT_EQ(two, reconstruct(deep, base, coefficients, dequantisation, 2));
  EXPECT_NE(two, subdivided(shallow, base, 2));
  const Positions three = reconstruct(deep, base, coefficients, dequantisation, 3);
  EXPECT_EQ(reconstruct(deep, base, coefficients, dequantisation, 4),
            subdivide(deep.level(3), three));
}

// A detail moves its odd vertex along the frame it is expressed in, tangent 1 along the base edge's
// direction. By how much of its length depends on what else falls on the vertex: 10/16 (12/16 on
// sharp edges, more or less where taps reflect onto it) or, with the local filter, all of it but
// the lifts of its end points, which valence 3 doubles.
TEST_P(Synthesis, PutsADetailWhereItsCellIs) {
  const SubdivisionHierarchy hierarchy(topology_of(shape()), 1, transform());
  const Positions base = positions_of(shape().mesh);
  const surface::Dequantisation dequantisation{0.5f, 4.0f};
  const double mean_area = surface::mean_face_area(hierarchy.base(), base);
  const Positions smooth = subdivided(hierarchy, base, 1);
  const auto& level = hierarchy.level(0);
  for (std::size_t cell = 0; cell < hierarchy.base_edges().size(); ++cell) {
    auto coefficients = empty_coefficients(hierarchy, 1);
    coefficients.channels[bitstream::kTangent1][cell] = 3;
    const Positions moved = reconstruct(hierarchy, base, coefficients, dequantisation, 1);
    const auto& ends = hierarchy.base_edges()[cell].vertices;
    const std::size_t odd = level.vertex_count + level.edges.cell_to_edge[cell];
    const Eigen::Vector3d move = point_at(moved, odd) - point_at(smooth, odd);
    const Eigen::Vector3d along = point_at(smooth, ends[1]) - point_at(smooth, ends[0]);
    const double area = tangents_at(level, smooth, level.edges.cell_to_edge[cell]).triangle_area();
    const double length =
        1.5 * 0.5 * 4.0 / static_cast<double>(surface::area_weight(area, mean_area));
    EXPECT_GT(move.normalized().dot(along.normalized()), 0.9);
    EXPECT_GE(move.norm(), (transform() == kLocal ? 0.89 : 0.49) * length);
    EXPECT_LE(move.norm(), 1.01 * length);
  }
}

TEST_P(Synthesis, StaysFiniteOnADegenerateBase) {
  const SubdivisionHierarchy hierarchy(topology_of(shape()), 3, transform());
  auto coefficients = empty_coefficients(hierarchy, 3);
  for (auto& channel : coefficients.channels)
    for (auto& value : channel) value = 5;
  Positions line = positions_of(shape().mesh);
  for (std::size_t k = 0; k < line.size(); ++k)
    if (k % 3 != 0) line[k] = 1.0f;
  for (const Positions& base : {Positions(line.size(), 1.0f), line}) {
    const Positions points = reconstruct(hierarchy, base, coefficients, {}, 3);
    Positions positions(points.size()), normals(points.size());
    limit_surface(hierarchy.level(3), points, {positions.data()}, {normals.data()});
    for (const float x : positions) ASSERT_TRUE(std::isfinite(x));
    for (const float x : normals) ASSERT_TRUE(std::isfinite(x));
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, Synthesis,
                         testing::Combine(testing::ValuesIn(base_shapes()),
                                          testing::ValuesIn(kTransforms)),
                         [](const auto& test) {
                           return std::get<0>(test.param).name + "_" +
                                  name_of(std::get<1>(test.param));
                         });

// A cube's details stay in the face they are in, those of its creases on the crease.
TEST(QuadratureMirror, DetailsDoNotReachAcrossCreases) {
  const Shape cube = base_shapes()[2];
  ASSERT_EQ(cube.name, "cube");
  const SubdivisionHierarchy hierarchy(topology_of(cube), 3, kQuadratureMirror);
  std::vector<Eigen::Vector3d> flat = cube.mesh.positions;
  for (int number = 0; number < 3; ++number) {
    const auto& level = hierarchy.level(number);
    append_midpoints(level, flat);
    for (std::size_t edge = 0; edge < level.edge_count; ++edge) {
      const unsigned own = cube_planes(flat[level.vertex_count + edge]);
      ASSERT_NE(own, 0u);
      for (const std::uint32_t vertex : level.details.row_indices(edge))
        EXPECT_EQ(cube_planes(flat[vertex]) & own, own);
    }
  }
}

}  // namespace
}  // namespace zerotree::test
