// Takes the side branches off chains of candidate creases.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace zerotree::domain {

/// An edge that may become a crease.
struct CreaseSegment {
  std::array<std::uint32_t, 2> ends;
  double length;
  bool strong;  ///< bent by the upper angle of the hysteresis
};

struct PruningRule {
  /// Weak arcs below either of these go.
  double min_length = 0;
  std::uint32_t min_edges = 6;
};

/// Of each segment 1 if it stays. An arc is a path between ends and junctions; it is weak if less
/// than half of its segments are strong. Noise beside a crease hangs weak, short arcs on it, which
/// would make its chain look like a thicket. They go first where they end freely, then between
/// junctions, until none is left. Linear for each round; few are needed.
std::vector<std::uint8_t> prune_weak_arcs(std::size_t vertex_count,
                                          const std::vector<CreaseSegment>& segments,
                                          const PruningRule& rule);

}  // namespace zerotree::domain
