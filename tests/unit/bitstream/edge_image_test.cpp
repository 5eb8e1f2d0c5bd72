#include "bitstream/edge_image.h"

#include <gtest/gtest.h>

#include <array>
#include <map>
#include <set>

#include "bitstream/detail_state.h"
#include "shapes.h"

namespace zerotree::bitstream {
namespace {

TEST(EdgeImage, IndexAndCellAreInverse) {
  for (int level = 0; level < 5; ++level) {
    std::set<std::size_t> seen;
    const std::uint32_t n = 1u << level;
    for (std::uint32_t e = 0; e < 3; ++e) {
      for (std::uint32_t p = 0; p < n; ++p) {
        for (std::uint32_t q = 0; q < n; ++q) {
          const std::size_t i = cell_index(level, {e, p, q});
          const EdgeCell back = cell_at(level, i);
          EXPECT_EQ(back.base_edge, e);
          EXPECT_EQ(back.p, p);
          EXPECT_EQ(back.q, q);
          seen.insert(i);
        }
      }
    }
    EXPECT_EQ(seen.size(), 3u * n * n);
    EXPECT_EQ(*seen.rbegin(), 3u * n * n - 1);
  }
}

TEST(EdgeImage, ChildrenFollowTheirParent) {
  const std::size_t parent = cell_index(3, {7, 5, 2});
  EXPECT_EQ(cell_index(4, {7, 10, 4}), parent * 4);      // near vertices[0]
  EXPECT_EQ(cell_index(4, {7, 10, 5}), parent * 4 + 1);  // side 1
  EXPECT_EQ(cell_index(4, {7, 11, 4}), parent * 4 + 2);  // side 0
  EXPECT_EQ(cell_index(4, {7, 11, 5}), parent * 4 + 3);  // near vertices[1]
}

TEST(EdgeImage, WorksAtTheDeepestLevel) {
  const EdgeCell corner{5, (1u << 13) - 1, 1};
  const EdgeCell back = cell_at(13, cell_index(13, corner));
  EXPECT_EQ(back.base_edge, corner.base_edge);
  EXPECT_EQ(back.p, corner.p);
  EXPECT_EQ(back.q, corner.q);
}

// The vertices of the subdivided base as barycentric places, and from them, with no help from the
// edge images' arithmetic across base edges, which edges share a triangle.
using Place = std::map<std::uint32_t, std::uint32_t>;  // base vertex -> weight, of sum n
using Ends = std::set<Place>;

Place place_of(const std::array<std::uint32_t, 3>& face, const std::array<std::uint32_t, 3>& w) {
  Place place;
  for (int k = 0; k < 3; ++k) {
    if (w[k] > 0) place[face[k]] += w[k];
  }
  return place;
}

// The two ends of a cell by the definition in coefficient_layout.h.
Ends ends_of(const BaseTopology& base, const BaseEdge& edge, const EdgeCell& cell, int level) {
  const std::uint32_t n = 1u << level;
  const std::uint32_t row = cell.p > cell.q ? cell.p - cell.q : cell.q - cell.p;
  const std::uint32_t s = std::min(cell.p, cell.q);
  const int side = cell.p >= cell.q ? 0 : 1;
  const auto& face = base.triangles[edge.faces[side]];
  const int local = edge.local[side];
  const std::uint32_t apex = face[(local + 2) % 3];
  const std::array<std::uint32_t, 3> corners = {edge.vertices[0], edge.vertices[1], apex};
  return {place_of(corners, {n - row - s, s, row}),
          place_of(corners, {n - row - s - 1, s + 1, row})};
}

std::vector<Ends> small_triangles(const BaseTopology& base, int level) {
  std::vector<Ends> triangles;
  const std::uint32_t n = 1u << level;
  for (const auto& face : base.triangles) {
    for (std::uint32_t i = 0; i < n; ++i) {
      for (std::uint32_t j = 0; i + j < n; ++j) {
        const std::uint32_t k = n - 1 - i - j;
        triangles.push_back({place_of(face, {i + 1, j, k}), place_of(face, {i, j + 1, k}),
                             place_of(face, {i, j, k + 1})});
        if (k == 0) continue;
        triangles.push_back({place_of(face, {i + 1, j + 1, k - 1}), place_of(face, {i, j + 1, k}),
                             place_of(face, {i + 1, j, k})});
      }
    }
  }
  return triangles;
}

TEST(DetailState, ScattersToTheEdgesOfTheSameTriangles) {
  constexpr int kLevel = 2;
  for (const test::Shape& shape : test::base_shapes()) {
    const BaseTopology base{
        static_cast<std::uint32_t>(shape.mesh.positions.size()), shape.mesh.triangles, {}, {}};
    const BaseEdges numbering = number_base_edges(base);
    std::map<Ends, std::size_t> cell_of;
    std::vector<Ends> ends(numbering.edges.size() << (2 * kLevel));
    for (std::size_t i = 0; i < ends.size(); ++i) {
      const EdgeCell cell = cell_at(kLevel, i);
      const BaseEdge& edge = numbering.edges[cell.base_edge];
      if (cell.p < cell.q && edge.faces[1] == kNone) continue;
      ends[i] = ends_of(base, edge, cell, kLevel);
      ASSERT_TRUE(cell_of.emplace(ends[i], i).second) << shape.name;
    }
    std::map<std::size_t, std::set<std::size_t>> expected;
    for (const Ends& triangle : small_triangles(base, kLevel)) {
      std::vector<std::size_t> cells;
      for (const Place& left_out : triangle) {
        Ends edge = triangle;
        edge.erase(left_out);
        ASSERT_TRUE(cell_of.count(edge)) << shape.name;
        cells.push_back(cell_of.at(edge));
      }
      for (const std::size_t a : cells) {
        for (const std::size_t b : cells) {
          if (a != b) expected[a].insert(b);
        }
      }
    }
    for (const auto& [index, neighbours] : expected) {
      DetailState state(numbering, kLevel + 1);
      state.activate(kNormal, kLevel);
      state.set_significant(kNormal, kLevel, index, 0, false);
      std::set<std::size_t> found;
      for (std::size_t i = 0; i < ends.size(); ++i) {
        // Face neighbours lean towards the sign, collinear ones away, others not at all.
        if (state.cells(kNormal, kLevel).lean[i] > 0) found.insert(i);
      }
      ASSERT_EQ(found, neighbours) << shape.name << " cell " << index;
    }
  }
}

TEST(DetailState, CellsBeyondABoundaryAreAbsent) {
  const BaseEdges one = number_base_edges({3, {{0, 1, 2}}, {}, {}});
  DetailState state(one, 3);
  state.activate(kTangent1, 2);
  for (int level = 0; level < 3; ++level) {
    int present = 0;
    for (std::size_t i = 0; i < state.level_size(level); ++i) {
      present += state.cells(kTangent1, level).flags[i] == 0 ? 1 : 0;
    }
    const int n = 1 << level;
    EXPECT_EQ(present, 3 * n * (n + 1) / 2);
  }
}

}  // namespace
}  // namespace zerotree::bitstream
