// The cut border: the state of the region growing that codes the base connectivity.
//
// A region of triangles grows one triangle at a time. Its border is a set of closed loops of
// gates; across each gate lies either one more triangle or the end of the mesh. Encoder and decoder
// drive the same state machine with the same actions, so nothing but the actions is coded.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "bitstream/base_topology.h"

namespace zerotree::bitstream {

/// What lies across a gate (u -> v) whose loop reads ... p -> u -> v -> n ...
enum class GateActionKind : std::uint8_t {
  kBoundary,  ///< nothing: (u, v) is a boundary edge of the mesh
  kLeft,      ///< triangle (u, v, p): the fan of u is complete
  kRight,     ///< triangle (u, v, n): the fan of v is complete
  kNew,       ///< triangle (u, v, w) with a vertex w not seen before
  kJoin,      ///< triangle (u, v, w) with w elsewhere on the border: splits a loop or joins two
};

struct GateAction {
  GateActionKind kind;
  /// kJoin only: the border node of w, kNone otherwise.
  std::uint32_t node;
};

/// One corner of the border: a vertex and the gate from it to the vertex of `next`. A vertex may
/// have several nodes. Nodes are numbered in order of creation and never reused.
struct BorderNode {
  std::uint32_t vertex;
  std::uint32_t previous;
  std::uint32_t next;
  bool alive;
  /// False when the gate is known to be a boundary edge of the mesh.
  bool open;
};

/// The border of a growing region and the order in which its gates are worked on. Vertices are
/// numbered in order of appearance. All operations together take time and memory linear in the
/// number of triangles.
class CutBorder {
 public:
  /// The nodes whose gates are the two outer edges of the latest triangle (u, v, w): u -> w and
  /// w -> v, each kNone where that edge closed an existing gate.
  struct NewGates {
    std::uint32_t from_u;
    std::uint32_t to_v;
  };

  /// Starts a component with the triangle of the next three new vertices a, b, c. The gates of its
  /// edges ab, bc, ca (which run the other way) belong to the returned nodes, in this order.
  std::array<std::uint32_t, 3> seed();

  /// The node of the gate to work on next, or kNone when no gate is open. The fan of one vertex is
  /// completed before the next begins: the one with the most edges so far, the latest of equals,
  /// which keeps the border short and convex and so makes kJoin rare.
  std::uint32_t next_gate();

  /// Whether `action` at the gate of node `a` keeps the border consistent. kNew is always allowed.
  bool allows(std::uint32_t a, GateAction action) const;

  /// Carries out an allowed action at the gate of node `a`, the result of next_gate().
  NewGates apply(std::uint32_t a, GateAction action);

  /// Third vertex of the triangle that an allowed action attaches to the gate of node `a`.
  std::uint32_t apex(std::uint32_t a, GateAction action) const;

  const std::vector<BorderNode>& nodes() const { return nodes_; }
  std::uint32_t vertex_count() const { return static_cast<std::uint32_t>(degree_.size()); }
  /// Edges met so far at a vertex.
  std::uint32_t degree(std::uint32_t vertex) const { return degree_[vertex]; }

 private:
  static constexpr std::size_t kBuckets = 16;

  bool is_open(std::uint32_t node) const { return nodes_[node].alive && nodes_[node].open; }
  std::size_t bucket(std::uint32_t node) const;
  std::uint32_t add_node(std::uint32_t vertex);
  std::uint32_t add_vertex();
  void link(std::uint32_t from, std::uint32_t to);
  void enqueue(std::uint32_t node);
  void close_if_pair(std::uint32_t node, NewGates& gates);
  NewGates close_fan(std::uint32_t removed, std::uint32_t from, std::uint32_t to);
  NewGates insert(std::uint32_t a, GateAction action);

  std::vector<BorderNode> nodes_;
  std::vector<std::uint32_t> degree_;
  // Nodes by degree; entries go stale and are dropped or moved when they come up.
  std::array<std::vector<std::uint32_t>, kBuckets> queue_;
  std::uint32_t focus_ = kNone;
};

}  // namespace zerotree::bitstream
