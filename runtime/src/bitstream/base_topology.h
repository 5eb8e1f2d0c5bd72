// The base mesh as the bitstream sees it: connectivity and sharpness tags, integers only.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace zerotree::bitstream {

inline constexpr std::uint32_t kNone = 0xffffffffu;

/// Connectivity of the base mesh: an oriented 2-manifold, possibly with boundary, possibly of
/// several components. The order of the vertices and of the triangles and the first corner of
/// each triangle are part of the data: they number edges, details and finer vertices.
struct BaseTopology {
  std::uint32_t vertex_count = 0;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  /// Interior edges that are infinitely sharp, each as (lower, higher) vertex; ascending, unique.
  std::vector<std::array<std::uint32_t, 2>> crease_edges;
  /// Vertices that are infinitely sharp; ascending, unique.
  std::vector<std::uint32_t> corner_vertices;
};

/// An edge of the base mesh. Side 0 is the first face (in face order) that has the edge; there it
/// runs from vertices[0] to vertices[1]. Side 1 is the opposite face, kNone on a boundary.
struct BaseEdge {
  std::array<std::uint32_t, 2> vertices;
  std::array<std::uint32_t, 2> faces;
  /// Which edge of that face it is: local edge k runs from corner k to corner (k + 1) mod 3.
  std::array<std::uint8_t, 2> local;
};

}  // namespace zerotree::bitstream
