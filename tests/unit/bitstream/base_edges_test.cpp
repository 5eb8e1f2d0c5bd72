#include "bitstream/base_edges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "shapes.h"

namespace zerotree::bitstream {
namespace {

BaseTopology topology_of(const test::Shape& shape) {
  return {static_cast<std::uint32_t>(shape.mesh.positions.size()), shape.mesh.triangles,
          shape.crease_edges, shape.corner_vertices};
}

TEST(BaseEdges, NumbersInOrderOfAppearance) {
  const BaseEdges two = number_base_edges({4, {{0, 1, 2}, {2, 1, 3}}, {}, {}});
  ASSERT_EQ(two.error, "");
  ASSERT_EQ(two.edges.size(), 5u);
  EXPECT_EQ(two.edges[0].vertices, (std::array<std::uint32_t, 2>{0, 1}));
  EXPECT_EQ(two.edges[1].vertices, (std::array<std::uint32_t, 2>{1, 2}));
  EXPECT_EQ(two.edges[1].faces, (std::array<std::uint32_t, 2>{0, 1}));
  EXPECT_EQ(two.edges[1].local, (std::array<std::uint8_t, 2>{1, 0}));
  EXPECT_EQ(two.edges[3].vertices, (std::array<std::uint32_t, 2>{1, 3}));
  EXPECT_EQ(two.edges[3].faces[1], kNone);
  EXPECT_EQ(two.face_edges[1], (std::array<std::uint32_t, 3>{1, 3, 4}));
}

TEST(BaseEdges, AgreesWithFacesOnEveryShape) {
  for (const test::Shape& shape : test::base_shapes()) {
    const BaseTopology base = topology_of(shape);
    const BaseEdges numbering = number_base_edges(base);
    ASSERT_EQ(numbering.error, "") << shape.name;
    std::set<std::array<std::uint32_t, 2>> unique;
    std::uint32_t highest = 0;
    for (std::uint32_t f = 0; f < base.triangles.size(); ++f) {
      for (std::uint8_t k = 0; k < 3; ++k) {
        const std::uint32_t e = numbering.face_edges[f][k];
        ASSERT_LE(e, highest);
        highest = std::max(highest, e + 1);
        const BaseEdge& edge = numbering.edges[e];
        const bool first = edge.faces[0] == f && edge.local[0] == k;
        EXPECT_TRUE(first || (edge.faces[1] == f && edge.local[1] == k));
        EXPECT_EQ(edge.vertices[first ? 0 : 1], base.triangles[f][k]);
        EXPECT_EQ(edge.vertices[first ? 1 : 0], base.triangles[f][(k + 1) % 3]);
        unique.insert({std::min(edge.vertices[0], edge.vertices[1]),
                       std::max(edge.vertices[0], edge.vertices[1])});
      }
    }
    EXPECT_EQ(highest, numbering.edges.size());
    EXPECT_EQ(unique.size(), numbering.edges.size());
  }
}

TEST(BaseEdges, RefusesWhatIsNoOrientedManifold) {
  const auto error = [](std::vector<std::array<std::uint32_t, 3>> triangles) {
    return number_base_edges({5, std::move(triangles), {}, {}}).error;
  };
  EXPECT_EQ(error({{0, 1, 5}}), "base face 0 names a vertex that does not exist");
  EXPECT_EQ(error({{0, 1, 2}, {3, 3, 4}}), "base face 1 repeats a vertex");
  EXPECT_EQ(error({{0, 1, 2}, {0, 1, 3}}), "base face 1 is oriented against its neighbour");
  EXPECT_EQ(error({{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}), "base face 2 is the third at one edge");
  EXPECT_EQ(error({}), "");
}

}  // namespace
}  // namespace zerotree::bitstream
