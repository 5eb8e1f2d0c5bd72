// Numbering of the base mesh's edges: the roots of the edge forest.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "bitstream/base_topology.h"

namespace zerotree::bitstream {

/// The edges of a base mesh, or why it has none.
struct BaseEdges {
  /// In order of first appearance, face by face and corner by corner: local edge k of a face runs
  /// from its corner k to its corner (k + 1) mod 3.
  std::vector<BaseEdge> edges;
  /// Per face the numbers of its three local edges.
  std::vector<std::array<std::uint32_t, 3>> face_edges;
  /// Empty, or a sentence that says which face breaks the rules; then the lists are empty too.
  std::string error;
};

/// Numbers the edges of `topology`. Refused are corners out of range, faces with a repeated
/// corner, edges with more than two faces and edges that two faces run through in the same
/// direction. Costs O(F log F); any input is safe.
BaseEdges number_base_edges(const BaseTopology& topology);

}  // namespace zerotree::bitstream
