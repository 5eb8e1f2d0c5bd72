#include "remesh/lattice_numbering.h"

#include <algorithm>
#include <array>
#include <map>

namespace zerotree::remesh {
namespace {

// One level: the corners and edges of every face, and each edge's first end.
struct Level {
  std::uint32_t vertex_count = 0;
  std::vector<std::array<std::uint32_t, 3>> corners, edges;
  std::vector<std::uint32_t> edge_start;
  /// Of each face: corner 0 and the steps towards corners 1 and 2 in units of the finest lattice.
  std::vector<std::array<std::int32_t, 2>> origin;
  std::vector<std::int32_t> step;  // negative for faces that point down
};

// Edges are numbered as they first occur in the faces, as OpenSubdiv numbers them.
Level base_level(const bitstream::BaseTopology& base, std::int32_t steps) {
  Level level;
  level.vertex_count = base.vertex_count;
  level.corners = base.triangles;
  std::map<std::array<std::uint32_t, 2>, std::uint32_t> edges;
  for (const auto& t : base.triangles) {
    std::array<std::uint32_t, 3>& face_edges = level.edges.emplace_back();
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k], b = t[(k + 1) % 3];
      const auto [it, is_new] = edges.try_emplace({std::min(a, b), std::max(a, b)},
                                                  static_cast<std::uint32_t>(edges.size()));
      if (is_new) level.edge_start.push_back(a);
      face_edges[k] = it->second;
    }
    level.origin.push_back({0, 0});
    level.step.push_back(steps);
  }
  return level;
}

// Children as in SemiRegularMesh; edge 3f + k lies opposite corner k of face f, in child k.
Level quadrisect(const Level& coarse) {
  const auto faces = static_cast<std::uint32_t>(coarse.corners.size());
  const auto edges = static_cast<std::uint32_t>(coarse.edge_start.size());
  Level fine;
  fine.vertex_count = coarse.vertex_count + edges;
  fine.edge_start.resize(3 * faces + 2 * edges);
  for (std::uint32_t e = 0; e < edges; ++e) {
    // OpenSubdiv lets both halves start at the midpoint.
    fine.edge_start[3 * faces + 2 * e] = coarse.vertex_count + e;
    fine.edge_start[3 * faces + 2 * e + 1] = coarse.vertex_count + e;
  }
  fine.corners.reserve(4 * std::size_t{faces});
  fine.edges.reserve(4 * std::size_t{faces});
  fine.origin.reserve(4 * std::size_t{faces});
  fine.step.reserve(4 * std::size_t{faces});
  for (std::uint32_t f = 0; f < faces; ++f) {
    const auto& v = coarse.corners[f];
    const auto& e = coarse.edges[f];
    const std::uint32_t m0 = coarse.vertex_count + e[0], m1 = coarse.vertex_count + e[1],
                        m2 = coarse.vertex_count + e[2];
    const auto half = [&](int k, std::uint32_t end) {
      return 3 * faces + 2 * e[k] + (coarse.edge_start[e[k]] == end ? 0 : 1);
    };
    fine.corners.insert(fine.corners.end(),
                        {{v[0], m0, m2}, {m0, v[1], m1}, {m2, m1, v[2]}, {m1, m2, m0}});
    fine.edges.insert(fine.edges.end(), {{half(0, v[0]), 3 * f, half(2, v[0])},
                                         {half(0, v[1]), half(1, v[1]), 3 * f + 1},
                                         {3 * f + 2, half(1, v[2]), half(2, v[2])},
                                         {3 * f + 2, 3 * f, 3 * f + 1}});
    fine.edge_start[3 * f] = m0;
    fine.edge_start[3 * f + 1] = m1;
    fine.edge_start[3 * f + 2] = m2;
    const auto [x, y] = coarse.origin[f];
    const std::int32_t h = coarse.step[f] / 2;
    fine.origin.insert(fine.origin.end(), {{x, y}, {x + h, y}, {x, y + h}, {x + h, y + h}});
    fine.step.insert(fine.step.end(), {h, h, h, -h});
  }
  return fine;
}

}  // namespace

LatticeNumbering number_lattices(const bitstream::BaseTopology& base, int levels) {
  LatticeNumbering numbering;
  numbering.levels = levels;
  numbering.vertices.resize(base.triangles.size() * numbering.points_per_triangle());
  // The last level's faces, the most by far, are never made: its vertices lie at the corners and on
  // the edges of the faces before.
  const int built = std::max(levels - 1, 0);
  Level level = base_level(base, static_cast<std::int32_t>(numbering.steps()));
  for (int j = 0; j < built; ++j) level = quadrisect(level);
  const auto edges = static_cast<std::uint32_t>(level.edge_start.size());
  numbering.vertex_count = level.vertex_count + (levels > 0 ? edges : 0);
  const std::uint32_t faces_per_triangle = 1u << (2 * built);
  for (std::uint32_t f = 0; f < level.corners.size(); ++f) {
    const std::size_t first = f / faces_per_triangle * numbering.points_per_triangle();
    const auto set = [&](std::int32_t i, std::int32_t j, std::uint32_t vertex) {
      numbering.vertices[first + numbering.row_offset(static_cast<std::uint32_t>(j)) +
                         static_cast<std::size_t>(i)] = vertex;
    };
    const auto [x, y] = level.origin[f];
    const std::int32_t step = level.step[f];
    set(x, y, level.corners[f][0]);
    set(x + step, y, level.corners[f][1]);
    set(x, y + step, level.corners[f][2]);
    if (levels == 0) continue;
    set(x + step / 2, y, level.vertex_count + level.edges[f][0]);
    set(x + step / 2, y + step / 2, level.vertex_count + level.edges[f][1]);
    set(x, y + step / 2, level.vertex_count + level.edges[f][2]);
  }
  return numbering;
}

std::uint64_t count_finest_vertices(const bitstream::BaseTopology& base, int levels) {
  std::uint64_t vertices = base.vertex_count, faces = base.triangles.size();
  std::map<std::array<std::uint32_t, 2>, int> seen;
  for (const auto& t : base.triangles)
    for (int k = 0; k < 3; ++k)
      seen[{std::min(t[k], t[(k + 1) % 3]), std::max(t[k], t[(k + 1) % 3])}] = 1;
  std::uint64_t edges = seen.size();
  for (int j = 0; j < levels; ++j) {
    vertices += edges;
    edges = 2 * edges + 3 * faces;
    faces *= 4;
  }
  return vertices;
}

}  // namespace zerotree::remesh
