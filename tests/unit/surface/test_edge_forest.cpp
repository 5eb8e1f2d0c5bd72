// OpenSubdiv's numbering, on which the format rests, and the places of edges in the stream.
#include "surface/edge_forest.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "bitstream/base_edges.h"
#include "bitstream/coefficient_layout.h"
#include "surface_shapes.h"

namespace zerotree::test {
namespace {

using bitstream::kNone;
using surface::SubdivisionHierarchy;

class EdgeForest : public testing::TestWithParam<Shape> {};

TEST_P(EdgeForest, BaseKeepsTheOrderOfVerticesAndFaces) {
  const auto topology = topology_of(GetParam());
  const SubdivisionHierarchy hierarchy(topology, 0, kQuadratureMirror);
  EXPECT_EQ(hierarchy.level(0).vertex_count, topology.vertex_count);
  EXPECT_EQ(hierarchy.level(0).triangles, topology.triangles);
}

TEST_P(EdgeForest, ChildrenAreNumberedByTheirParents) {
  const auto topology = topology_of(GetParam());
  const auto edges = bitstream::number_base_edges(topology).edges;
  const auto refiner = surface::make_loop_refiner(topology, edges, 3);
  for (int number = 0; number < 3; ++number) {
    const auto& level = refiner->GetLevel(number);
    const auto& child = refiner->GetLevel(number + 1);
    const int vertices = level.GetNumVertices(), faces = level.GetNumFaces();
    for (int vertex = 0; vertex < vertices; ++vertex)
      ASSERT_EQ(level.GetVertexChildVertex(vertex), vertex);
    for (int edge = 0; edge < level.GetNumEdges(); ++edge) {
      ASSERT_EQ(level.GetEdgeChildVertex(edge), vertices + edge);
      for (int half = 0; half < 2; ++half) {
        const int child_edge = 3 * faces + 2 * edge + half;
        ASSERT_EQ(level.GetEdgeChildEdges(edge)[half], child_edge);
        ASSERT_EQ(child.GetEdgeVertices(child_edge)[0], vertices + edge);
        ASSERT_EQ(child.GetEdgeVertices(child_edge)[1], level.GetEdgeVertices(edge)[half]);
      }
    }
    for (int face = 0; face < faces; ++face) {
      for (int k = 0; k < 4; ++k) ASSERT_EQ(level.GetFaceChildFaces(face)[k], 4 * face + k);
      for (int k = 0; k < 3; ++k) {
        // Child edge k cuts off corner k; it is parallel to the edge opposite that corner.
        ASSERT_EQ(level.GetFaceChildEdges(face)[k], 3 * face + k);
        const auto odd = [&](int local) { return vertices + level.GetFaceEdges(face)[local % 3]; };
        ASSERT_EQ(child.GetEdgeVertices(3 * face + k)[0], odd(k));
        ASSERT_EQ(child.GetEdgeVertices(3 * face + k)[1], odd(k + 2));
        const auto corner_child = child.GetFaceVertices(4 * face + k);
        ASSERT_EQ(corner_child[k], level.GetFaceVertices(face)[k]);
        ASSERT_EQ(corner_child[(k + 1) % 3], odd(k));
        ASSERT_EQ(corner_child[(k + 2) % 3], odd(k + 2));
        ASSERT_EQ(child.GetFaceVertices(4 * face + 3)[k], odd(k + 1));
      }
    }
  }
}

TEST_P(EdgeForest, EveryEdgeHasOneCell) {
  const SubdivisionHierarchy hierarchy(topology_of(GetParam()), 4, kQuadratureMirror);
  for (int number = 0; number < 4; ++number) {
    const auto& level = hierarchy.level(number);
    const auto& cells = level.edges.cell_to_edge;
    ASSERT_EQ(cells.size(), hierarchy.base_edges().size() << (2 * number));
    std::vector<int> uses(level.edge_count, 0);
    for (const std::uint32_t edge : cells)
      if (edge != kNone) ++uses.at(edge);
    EXPECT_EQ(std::count(uses.begin(), uses.end(), 1), std::ptrdiff_t{level.edge_count});
  }
}

/// Bits of a Morton index at every second place.
std::uint32_t even_bits(std::size_t morton) {
  std::uint32_t value = 0;
  for (int bit = 0; bit < 16; ++bit)
    value |= static_cast<std::uint32_t>((morton >> (2 * bit)) & 1u) << bit;
  return value;
}

// The midpoint of cell (p, q) of base edge e is where coefficient_layout.h says it is: in the plane
// of side 0 or 1, |p - q| rows away, the s-th from vertices[0]; and it runs along the base edge.
TEST_P(EdgeForest, CellsLieWhereTheLayoutSays) {
  constexpr int kLevel = 3;
  const SubdivisionHierarchy hierarchy(topology_of(GetParam()), kLevel + 1, kQuadratureMirror);
  TriangleMesh flat = GetParam().mesh;
  std::vector<Eigen::Vector3d> points = flat.positions;
  for (int number = 0; number < kLevel; ++number) {
    const auto& level = hierarchy.level(number);
    for (const auto& [tail, head] : level.edges.vertices)
      points.push_back(0.5 * (points[tail] + points[head]));
  }
  const int n = 1 << kLevel;
  const auto& edges = hierarchy.level(kLevel).edges;
  for (std::size_t cell = 0; cell < edges.cell_to_edge.size(); ++cell) {
    const auto& base = hierarchy.base_edges()[cell >> (2 * kLevel)];
    const int p = static_cast<int>(even_bits(cell >> 1)) % n;
    const int q = static_cast<int>(even_bits(cell)) % n;
    const std::size_t side = p < q ? 1 : 0;
    if (base.faces[side] == kNone) {
      EXPECT_EQ(edges.cell_to_edge[cell], kNone);
      continue;
    }
    const auto& corners = hierarchy.base().triangles[base.faces[side]];
    const Eigen::Vector3d start = flat.positions[base.vertices[0]];
    const Eigen::Vector3d along = flat.positions[base.vertices[1]] - start;
    const Eigen::Vector3d up = flat.positions[corners[(base.local[side] + 2u) % 3]] - start;
    const Eigen::Vector3d tail = start + (std::min(p, q) * along + std::abs(p - q) * up) / n;
    const auto& [from, to] = edges.vertices.at(edges.cell_to_edge[cell]);
    EXPECT_LT((points[from] - tail).norm(), 1e-9);
    EXPECT_LT((points[to] - tail - along / n).norm(), 1e-9);
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, EdgeForest, testing::ValuesIn(base_shapes()),
                         [](const auto& shape) { return shape.param.name; });

TEST(SubdivisionHierarchy, RefusesWhatIsNoSurface) {
  const auto build = [](const bitstream::BaseTopology& topology, int levels) {
    return SubdivisionHierarchy(topology, levels, kQuadratureMirror).levels();
  };
  EXPECT_THROW(build({}, 1), std::invalid_argument);
  EXPECT_THROW(build({3, {{0, 1, 3}}, {}, {}}, 1), std::invalid_argument);
  EXPECT_THROW(build({3, {{0, 1, 1}}, {}, {}}, 1), std::invalid_argument);
  EXPECT_THROW(build({4, {{0, 1, 2}}, {}, {}}, 1), std::invalid_argument) << "vertex without face";
  EXPECT_THROW(build({4, {{0, 1, 2}, {0, 1, 3}}, {}, {}}, 1), std::invalid_argument);
  EXPECT_THROW(build({5, {{0, 1, 2}, {0, 3, 4}}, {}, {}}, 1), std::invalid_argument) << "two fans";
  EXPECT_THROW(build({3, {{0, 1, 2}}, {{0, 1}}, {}}, 1), std::invalid_argument) << "crease";
  EXPECT_THROW(build({3, {{0, 1, 2}}, {}, {3}}, 1), std::invalid_argument) << "corner";
  EXPECT_THROW(build({3, {{0, 1, 2}}, {}, {}}, 15), std::invalid_argument);
  EXPECT_THROW(build({3, {{0, 1, 2}}, {}, {}}, -1), std::invalid_argument);
  EXPECT_EQ(build({3, {{0, 1, 2}}, {}, {}}, 2), 2);
}

}  // namespace
}  // namespace zerotree::test
