// The coded form of the base connectivity, for encoder and decoder alike. Sharp tags come after it:
// sharp_tag_coding.h.
//
// A bit coder offers `bool code(bool bit, AdaptiveBit& context)` and `bool code_raw(bool bit)`:
// that of the encoder writes the bit and returns it, that of the decoder ignores it and returns the
// bit read. So both run the same code, and extension-spec/BASE_CONNECTIVITY.md describes it once.
// `bool starved()` tells that the last call found no bits.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "bitstream/adaptive_bit.h"
#include "bitstream/base_topology.h"
#include "bitstream/base_traversal.h"
#include "bitstream/cut_border.h"

namespace zerotree::bitstream {

/// Counts known from the header before the connectivity is read.
struct BaseCounts {
  std::uint32_t vertices = 0;
  std::uint32_t triangles = 0;
};

/// Contexts of the connectivity: one adaptive bit per kind of decision and situation.
struct BaseConnectivityModel {
  // Whether the fan of u closes, by its edges so far and those of v: the distribution of valences.
  std::array<std::array<AdaptiveBit, 3>, 9> left;
  std::array<AdaptiveBit, 2> last_of_loop;   // kLeft in a loop of three: after no / some kLeft
  std::array<AdaptiveBit, 3> fresh;          // kNew, by edges of v
  std::array<AdaptiveBit, 3> right;          // kRight, by edges of v
  std::array<AdaptiveBit, 4> boundary;       // by whether the gates before and after are open
  AdaptiveBit near;                          // kJoin within kNearJoin steps
  AdaptiveBit backward;                      // its direction
  std::array<AdaptiveBit, 8> distance_bits;  // its distance: number of bits, unary
};

/// Codes one connectivity with one bit coder.
template <class BitCoder>
class BaseConnectivityCoder {
 public:
  explicit BaseConnectivityCoder(BitCoder& coder) : coder_(coder) {}

  /// Encoder: writes the triangles of `topology`. Fails, and what was written is of no use, if it
  /// is not what BaseTopology promises or not in canonical order.
  ConnectivityStatus encode(const BaseTopology& topology) {
    ConnectivityStatus status = check_base_topology(topology);
    if (!status.ok()) return status;
    BaseTopology copy;
    const BaseTraversal traversal = traverse_base(topology);
    counts_ = {topology.vertex_count, static_cast<std::uint32_t>(topology.triangles.size())};
    has_boundary_ = code_raw(traversal.has_boundary);
    forget_answers();
    std::size_t next = 0;
    status = grow_components(copy, [&] { return traversal.actions[next++]; });
    if (status.ok() && copy.triangles != topology.triangles) {
      status = {"the base mesh is not in canonical order"};
    }
    return status;
  }

  /// Decoder: reads a topology of exactly `counts` into `topology` (its old content is lost). If it
  /// fails because the coder is `starved`, it may be called again with the same arguments once the
  /// coder has more bytes, and goes on where it stopped. Safe on any bits: in all it takes time
  /// O(n log n) and memory O(n) in the triangles decoded until the bits end or make no sense, at
  /// most `counts`.
  ConnectivityStatus decode(BaseCounts counts, BaseTopology& topology) {
    starved_ = false;
    if (!begun_) {
      topology = {};
      counts_ = counts;
      has_boundary_ = code_raw(false);
      if (starved_) return ended();
      begun_ = true;
      forget_answers();
    }
    ConnectivityStatus status = grow_components(topology, [] {
      return GateAction{GateActionKind::kBoundary, kNone};
    });
    if (status.ok()) status = check_base_topology(topology);
    if (status.ok() && !has_boundary_ && !is_closed(topology)) {
      status = {"a closed base mesh has boundary edges"};
    }
    return status;
  }

  /// The last call of `decode` failed for want of bytes.
  bool starved() const { return starved_; }

 private:
  static constexpr std::uint32_t kNearJoin = 512;  // steps; nearer joins are coded by distance

  bool code(bool bit, AdaptiveBit& context) {
    return answer([&] { return coder_.code(bit, context); });
  }
  bool code_raw(bool bit) {
    return answer([&] { return coder_.code_raw(bit); });
  }

  /// The answers to one action's decisions are kept until the action is complete, so that a decoder
  /// that starves within an action repeats them when it comes back.
  template <class Ask>
  bool answer(Ask ask) {
    if (starved_) return false;
    if (answered_ == answers_.size()) {
      const bool bit = ask();
      starved_ = coder_.starved();
      if (starved_) return false;
      answers_.push_back(bit);
    }
    return answers_[answered_++];
  }

  ConnectivityStatus ended() {
    answered_ = 0;
    return {"the base connectivity is cut short"};
  }

  /// Rebuilds `topology` triangle by triangle; `expected` tells the encoder's next action.
  template <class Expected>
  ConnectivityStatus grow_components(BaseTopology& topology, Expected expected) {
    while (topology.triangles.size() < counts_.triangles) {
      const std::uint32_t a = border_.next_gate();
      if (a == kNone) {
        if (counts_.vertices - border_.vertex_count() < 3) return {"there are too few vertices"};
        const std::uint32_t v = border_.vertex_count();
        border_.seed();
        topology.triangles.push_back({v, v + 1, v + 2});
        continue;
      }
      const GateAction action = code_action(a, expected());
      if (starved_) return ended();
      forget_answers();
      if (!border_.allows(a, action)) return {"a gate joins where it cannot"};
      const BorderNode& u = border_.nodes()[a];
      const std::uint32_t w = border_.apex(a, action);
      if (w != kNone) {
        topology.triangles.push_back({u.vertex, border_.nodes()[u.next].vertex, w});
      }
      border_.apply(a, action);
    }
    topology.vertex_count = border_.vertex_count();
    if (topology.vertex_count != counts_.vertices) return {"fewer vertices are made than announced"};
    return {};
  }

  void forget_answers() {
    answers_.clear();
    answered_ = 0;
  }

  GateAction code_action(std::uint32_t a, GateAction expected) {
    const BorderNode& u = border_.nodes()[a];
    const BorderNode& p = border_.nodes()[u.previous];
    const BorderNode& v = border_.nodes()[u.next];
    const std::uint32_t degree_u = border_.degree(u.vertex);
    const std::uint32_t degree_v = border_.degree(v.vertex);
    const auto is = [&](GateActionKind kind, AdaptiveBit& context) {
      return code(expected.kind == kind, context);
    };
    if (has_boundary_ &&
        is(GateActionKind::kBoundary, model_.boundary[(p.open ? 0 : 2) + (v.open ? 0 : 1)])) {
      return {GateActionKind::kBoundary, kNone};
    }
    const std::uint32_t v_class = degree_v < 5 ? 0 : degree_v < 6 ? 1 : 2;
    if (border_.allows(a, {GateActionKind::kLeft, kNone})) {
      const bool last = v.next == u.previous;
      AdaptiveBit& context = last ? model_.last_of_loop[degree_u > 3]
                                  : model_.left[std::min(degree_u, 10u) - 2][v_class];
      if (is(GateActionKind::kLeft, context)) return {GateActionKind::kLeft, kNone};
    }
    if (border_.vertex_count() < counts_.vertices &&
        is(GateActionKind::kNew, model_.fresh[v_class])) {
      return {GateActionKind::kNew, kNone};
    }
    if (border_.allows(a, {GateActionKind::kRight, kNone}) &&
        is(GateActionKind::kRight, model_.right[v_class])) {
      return {GateActionKind::kRight, kNone};
    }
    return {GateActionKind::kJoin, code_join(a, expected.node)};
  }

  std::uint32_t code_join(std::uint32_t a, std::uint32_t node) {
    const std::vector<BorderNode>& nodes = border_.nodes();
    Step step = node == kNone ? Step{} : find_near(a, node);
    if (!code(step.distance != 0, model_.near)) {
      return code_number(node, static_cast<int>(std::bit_width(nodes.size() - 1)));
    }
    step.backward = code(step.backward, model_.backward);
    step.distance = code_distance(step.distance);
    std::uint32_t c = step.backward ? a : nodes[a].next;
    for (std::uint32_t i = 0; i < step.distance; ++i) {
      c = step.backward ? nodes[c].previous : nodes[c].next;
    }
    return c;
  }

  struct Step {
    bool backward = false;
    std::uint32_t distance = 0;  // 2 .. kNearJoin; 0: not near
  };

  /// The shorter way from the gate of `a` to `node` along the loop, forward when equal.
  Step find_near(std::uint32_t a, std::uint32_t node) const {
    const std::vector<BorderNode>& nodes = border_.nodes();
    std::uint32_t backward = a, forward = nodes[a].next;
    for (std::uint32_t distance = 1; distance <= kNearJoin; ++distance) {
      backward = nodes[backward].previous;
      forward = nodes[forward].next;
      if (forward == node) return {false, distance};
      if (backward == node) return {true, distance};
    }
    return {};
  }

  /// Distances 2 .. 512 as x = distance - 1 in 1 .. 511: the number of bits below its highest one,
  /// unary, then those bits.
  std::uint32_t code_distance(std::uint32_t distance) {
    const std::uint32_t x = distance == 0 ? 1 : distance - 1;
    const int expected = std::bit_width(x) - 1;
    int bits = 0;
    while (bits < 8 && code(bits < expected, model_.distance_bits[bits])) ++bits;
    const std::uint32_t low = code_number(x & ((1u << expected) - 1), bits);
    return (1u << bits) + low + 1;
  }

  std::uint32_t code_number(std::uint32_t value, int bits) {
    std::uint32_t result = 0;
    for (int k = bits; k-- > 0;) result |= std::uint32_t{code_raw((value >> k) & 1)} << k;
    return result;
  }

  static bool is_closed(const BaseTopology& topology) {
    std::vector<std::uint32_t> opposites;
    return find_opposites(topology, opposites).ok() &&
           std::find(opposites.begin(), opposites.end(), kNone) == opposites.end();
  }

  BitCoder& coder_;
  BaseConnectivityModel model_;
  CutBorder border_;
  BaseCounts counts_;
  bool has_boundary_ = false;
  bool begun_ = false;
  bool starved_ = false;
  std::vector<bool> answers_;  // of the action under way
  std::size_t answered_ = 0;   // so many of them have been repeated
};

/// Writes a base mesh in canonical order; see BaseConnectivityCoder::encode.
template <class BitCoder>
ConnectivityStatus encode_base_connectivity(BitCoder& coder, const BaseTopology& topology) {
  return BaseConnectivityCoder<BitCoder>(coder).encode(topology);
}

/// Reads a base mesh; see BaseConnectivityCoder::decode.
template <class BitCoder>
ConnectivityStatus decode_base_connectivity(BitCoder& coder, BaseCounts counts,
                                            BaseTopology& topology) {
  return BaseConnectivityCoder<BitCoder>(coder).decode(counts, topology);
}

}  // namespace zerotree::bitstream
