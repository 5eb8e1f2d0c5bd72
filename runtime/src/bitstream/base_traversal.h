// The canonical order of a base mesh and the actions that code its connectivity.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "bitstream/base_topology.h"
#include "bitstream/cut_border.h"

namespace zerotree::bitstream {

/// Whether connectivity is usable. `problem` is empty (a null pointer) when it is, else a constant
/// sentence that says what is wrong.
struct ConnectivityStatus {
  const char* problem = nullptr;
  bool ok() const { return problem == nullptr; }
};

/// A numbering of vertices, triangles and first corners.
struct BaseOrder {
  std::vector<std::uint32_t> vertices;      ///< old index of each new vertex
  std::vector<std::uint32_t> triangles;     ///< old index of each new triangle
  std::vector<std::uint8_t> first_corners;  ///< of each new triangle: which old corner comes first
};

/// The region growing over a mesh: its order, and what happens at each gate in turn.
struct BaseTraversal {
  BaseOrder order;
  std::vector<GateAction> actions;
  bool has_boundary = false;
};

/// For half-edge 3 f + k, from corner k to corner (k + 1) mod 3 of triangle f, the half-edge on the
/// other side of its edge; kNone on the boundary. Fails where two half-edges have the same ends.
/// Corners must be below `vertex_count`. O(n log n).
ConnectivityStatus find_opposites(const BaseTopology& topology,
                                  std::vector<std::uint32_t>& opposites);

/// Whether `topology` is what BaseTopology promises: indices in range, three different corners,
/// each edge once in either direction, each vertex used and with one fan of triangles, tags
/// ascending, unique and on interior edges and existing vertices. Safe on any content. O(n log n).
ConnectivityStatus check_base_topology(const BaseTopology& topology);

/// Whether every vertex of a `topology` that has these `edges` is used and has one fan of
/// triangles. What number_base_edges accepts and this too is an oriented 2-manifold. O(n).
ConnectivityStatus check_base_fans(const BaseTopology& topology,
                                   const std::vector<BaseEdge>& edges);

/// Grows a region over each component in the order of their first triangles, from that triangle and
/// its first corner. Only for a topology that passes check_base_topology. O(n log n).
BaseTraversal traverse_base(const BaseTopology& topology);

/// The order in which a decoder emits vertices and triangles: traverse_base's. The canonical order
/// of a reordered topology is the identity. Only for a topology that passes check_base_topology.
BaseOrder canonical_base_order(const BaseTopology& topology);

/// `topology` renumbered, tags included, which come out ascending.
BaseTopology reorder(const BaseTopology& topology, const BaseOrder& order);

}  // namespace zerotree::bitstream
