// The edges of each level: their direction, their neighbours and their place in the stream.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "bitstream/base_topology.h"
#include "surface/loop_refiner.h"

namespace zerotree::surface {

/// The edges of one level in OpenSubdiv's numbering. An edge runs in the direction of the base
/// edge it descends from (vertices[0] to vertices[1]), so that the tangential details of a base
/// edge's diamond have comparable signs.
struct EdgeLevel {
  /// {tail, head}
  std::vector<std::array<std::uint32_t, 2>> vertices;
  /// The other edges of the two faces: left face near the tail, near the head, right face near the
  /// tail, near the head. A boundary edge has no right face: kNone.
  std::vector<std::array<std::uint32_t, 4>> wings;
  /// Edge of each cell of bitstream/coefficient_layout.h, or kNone where a cell does not exist.
  std::vector<std::uint32_t> cell_to_edge;
};

/// The edges of the base. `base_edges` are the bitstream's; `base` is level 0 of the same mesh.
EdgeLevel base_edge_level(const RefinerLevel& base,
                          const std::vector<bitstream::BaseEdge>& base_edges);

/// The edges of `child`, the level below `parent`. In the image of a base edge, digit 0 is the half
/// at the tail, 3 the half at the head, 2 the parallel edge in the left face (side 0's "up"), 1 the
/// one in the right face.
EdgeLevel child_edge_level(const RefinerLevel& parent, const EdgeLevel& parent_edges,
                           const RefinerLevel& child);

}  // namespace zerotree::surface
