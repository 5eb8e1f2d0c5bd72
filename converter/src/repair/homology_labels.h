// Tells loops that part a surface from loops that do not.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "domain/triangle_topology.h"

namespace zerotree::repair {

/// Number of an edge: its half-edge 3 * face + edge, the lower of both.
inline std::uint32_t edge_number(const domain::TriangleTopology& topology, std::uint32_t face,
                                 int edge) {
  const std::uint32_t own = 3 * face + static_cast<std::uint32_t>(edge);
  const std::uint32_t other = topology.adjacent[face][edge];
  if (other == domain::kNone) return own;
  const int back = domain::edge_towards(topology, other, face);
  return std::min(own, 3 * other + static_cast<std::uint32_t>(back));
}

/// A bit for each of two loops a handle; the exclusive or over the edges of a closed path is zero
/// exactly if the path parts its component in two (holes count as filled).
struct HomologyLabels {
  /// 64-bit words of a label; 0 without handles.
  std::size_t words = 0;
  /// Vertices of loops, two for each handle, one of which every loop meets that parts nothing;
  /// ascending.
  std::vector<std::uint32_t> loop_vertices;

  std::uint64_t of(std::uint32_t edge, std::size_t word) const {
    const std::uint32_t row = row_of[edge];
    return row == domain::kNone ? 0 : rows[row * words + word];
  }

  std::vector<std::uint32_t> row_of;  // of each edge number, kNone where the label is zero
  std::vector<std::uint64_t> rows;
};

/// Linear but for the lengths of the loops.
HomologyLabels label_edges(const domain::TriangleTopology& topology);

}  // namespace zerotree::repair
