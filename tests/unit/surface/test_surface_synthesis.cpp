// From integers to control points.
#include "surface/surface_synthesis.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "bitstream/base_edges.h"
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
  const surface::Dequantisation dequantisation{kQuadratureMirror, 0.5f, 4.0f};
  EXPECT_FLOAT_EQ(detail_unit(dequantisation, 5, 4, bitstream::kNormal, 1.0f), 0.5f);
  EXPECT_FLOAT_EQ(detail_unit(dequantisation, 5, 4, bitstream::kTangent2, 2.0f), 1.0f);
  EXPECT_FLOAT_EQ(detail_unit(dequantisation, 5, 2, bitstream::kNormal, 1.0f), 0.5f / 2.16f);
  EXPECT_FLOAT_EQ(surface::basis_norm(kQuadratureMirror, 8), 4 * 33.5f);
}

TEST(DetailWeights, OfADegenerateBaseAreFinite) {
  const bitstream::BaseTopology topology{4, {{0, 1, 2}, {0, 2, 3}}, {}, {}};
  const auto edges = bitstream::number_base_edges(topology).edges;
  for (const Positions& positions :
       {Positions(12, 1.0f), Positions{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 0}})
    for (const float weight : surface::base_edge_weights(topology, edges, positions)) {
      EXPECT_GE(weight, 0.125f);
      EXPECT_LE(weight, 8.0f);
    }
}

class Synthesis : public testing::TestWithParam<Shape> {};

TEST_P(Synthesis, WithoutDetailsIsLoop) {
  const SubdivisionHierarchy hierarchy(topology_of(GetParam()), 3, kQuadratureMirror);
  const Positions base = positions_of(GetParam().mesh);
  EXPECT_EQ(reconstruct(hierarchy, base, empty_coefficients(hierarchy, 3), {}, 3),
            subdivided(hierarchy, base, 3));
}

// Levels above the asked one do not matter; a level beyond the coefficients' is subdivided on.
TEST_P(Synthesis, StopsAtTheLevelAsked) {
  const SubdivisionHierarchy shallow(topology_of(GetParam()), 2, kQuadratureMirror);
  const SubdivisionHierarchy deep(topology_of(GetParam()), 4, kQuadratureMirror);
  const Positions base = positions_of(GetParam().mesh);
  auto coefficients = empty_coefficients(deep, 3);
  std::mt19937 random(7);
  for (auto& channel : coefficients.channels)
    for (auto& value : channel) value = static_cast<int>(random() % 9) - 4;
  const surface::Dequantisation dequantisation{kQuadratureMirror, 0.01f, 4.0f};
  const Positions two = reconstruct(shallow, base, coefficients, dequantisation, 2);
  EXPECT_EQ(two, reconstruct(deep, base, coefficients, dequantisation, 2));
  EXPECT_NE(two, subdivided(shallow, base, 2));
  const Positions three = reconstruct(deep, base, coefficients, dequantisation, 3);
  EXPECT_EQ(reconstruct(deep, base, coefficients, dequantisation, 4),
            subdivide(deep.level(3), three));
}

// A detail moves its odd vertex by 10/16 (12/16 on sharp edges, more or less where taps reflect
// onto it) of its length along the frame it is expressed in: tangent 1 along the base edge's
// direction.
TEST_P(Synthesis, PutsADetailWhereItsCellIs) {
  const SubdivisionHierarchy hierarchy(topology_of(GetParam()), 1, kQuadratureMirror);
  const Positions base = positions_of(GetParam().mesh);
  const surface::Dequantisation dequantisation{kQuadratureMirror, 0.5f, 4.0f};
  const auto weights = surface::base_edge_weights(hierarchy.base(), hierarchy.base_edges(), base);
  const Positions smooth = subdivided(hierarchy, base, 1);
  const auto& level = hierarchy.level(0);
  for (std::size_t cell = 0; cell < hierarchy.base_edges().size(); ++cell) {
    auto coefficients = empty_coefficients(hierarchy, 1);
    coefficients.channels[bitstream::kTangent1][cell] = 3;
    const Positions moved = reconstruct(hierarchy, base, coefficients, dequantisation, 1);
    const auto& edge = hierarchy.base_edges()[cell];
    const std::size_t odd = level.vertex_count + level.edges.cell_to_edge[cell];
    const Eigen::Vector3d move = point_at(moved, odd) - point_at(smooth, odd);
    const Eigen::Vector3d along =
        point_at(smooth, edge.vertices[1]) - point_at(smooth, edge.vertices[0]);
    const double length = 1.5 * 0.5 * 4.0 / static_cast<double>(weights[cell]);
    EXPECT_GT(move.normalized().dot(along.normalized()), 0.9);
    EXPECT_GE(move.norm(), 0.49 * length);
    EXPECT_LE(move.norm(), 1.01 * length);
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, Synthesis, testing::ValuesIn(base_shapes()),
                         [](const auto& shape) { return shape.param.name; });

// A cube's details stay in the face they are in, those of its creases on the crease.
TEST(Synthesis, DetailsDoNotReachAcrossCreases) {
  const Shape cube = base_shapes()[2];
  ASSERT_EQ(cube.name, "cube");
  const SubdivisionHierarchy hierarchy(topology_of(cube), 3, kQuadratureMirror);
  std::vector<Eigen::Vector3d> flat = cube.mesh.positions;
  for (int number = 0; number < 3; ++number) {
    const auto& level = hierarchy.level(number);
    for (const auto& [tail, head] : level.edges.vertices)
      flat.push_back(0.5 * (flat[tail] + flat[head]));
    // The planes through a point, as bits; the cube's coordinates are 0 and 1.
    const auto planes = [&](std::size_t vertex) {
      unsigned bits = 0;
      for (int axis = 0; axis < 3; ++axis) {
        bits |= flat[vertex][axis] == 0.0 ? 1u << axis : 0u;
        bits |= flat[vertex][axis] == 1.0 ? 8u << axis : 0u;
      }
      return bits;
    };
    for (std::size_t edge = 0; edge < level.edge_count; ++edge) {
      const unsigned own = planes(level.vertex_count + edge);
      ASSERT_NE(own, 0u);
      for (const std::uint32_t vertex : level.details.row_indices(edge))
        EXPECT_EQ(planes(vertex) & own, own);
    }
  }
}

TEST(Synthesis, StaysFiniteOnADegenerateBase) {
  const Shape shape = base_shapes()[0];
  const SubdivisionHierarchy hierarchy(topology_of(shape), 3, kQuadratureMirror);
  const Positions collapsed(3 * shape.mesh.positions.size(), 1.0f);
  auto coefficients = empty_coefficients(hierarchy, 3);
  for (auto& channel : coefficients.channels)
    for (auto& value : channel) value = 5;
  const Positions points = reconstruct(hierarchy, collapsed, coefficients, {}, 3);
  Positions positions(points.size()), normals(points.size());
  limit_surface(hierarchy.level(3), points, {positions.data()}, {normals.data()});
  for (const float x : positions) ASSERT_TRUE(std::isfinite(x));
  for (const float x : normals) ASSERT_TRUE(std::isfinite(x));
}

}  // namespace
}  // namespace zerotree::test
