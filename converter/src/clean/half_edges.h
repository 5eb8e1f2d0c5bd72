// Flat half-edge tables of triangles. Half-edge h = 3f + k runs from corner k of face f to the
// next.
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/triangle_mesh.h"

namespace zerotree::clean {

constexpr std::uint32_t no_half_edge = 0xffffffffu;

inline std::uint32_t next_half_edge(std::uint32_t h) {
  return h % 3 == 2 ? h - 2 : h + 1;
}
inline std::uint32_t previous_half_edge(std::uint32_t h) {
  return h % 3 == 0 ? h + 2 : h - 1;
}

inline std::uint32_t tail_of(const std::vector<Triangle>& triangles, std::uint32_t h) {
  return triangles[h / 3][h % 3];
}
inline std::uint32_t head_of(const std::vector<Triangle>& triangles, std::uint32_t h) {
  return tail_of(triangles, next_half_edge(h));
}

/// All half-edges grouped by the undirected edge they lie on.
struct EdgeTable {
  /// Half-edges; those of one edge are neighbours, in ascending order.
  std::vector<std::uint32_t> half_edges;
  /// For each edge the index in `half_edges` of its first; one entry more at the end. Edges are in
  /// the order (lower vertex, higher vertex).
  std::vector<std::uint32_t> first;
  std::size_t edge_count() const { return first.size() - 1; }
};

/// Groups by counting sort over the lower vertex: O(F + V), but for edges of one vertex, which are
/// sorted, on all threads of oneTBB. 24 bytes a face in passing. No face may have a repeated
/// vertex.
EdgeTable make_edge_table(const std::vector<Triangle>& triangles, std::size_t vertex_count);

/// Mates of the half-edges of a mesh whose edges have at most two faces: no_half_edge at boundaries
/// and at edges with more.
std::vector<std::uint32_t> find_mates(const std::vector<Triangle>& triangles,
                                      std::size_t vertex_count);
std::vector<std::uint32_t> find_mates(const EdgeTable& table);

}  // namespace zerotree::clean
