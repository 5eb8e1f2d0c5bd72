// Crease and corner flags of a base.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "bitstream/adaptive_bit.h"
#include "bitstream/base_edges.h"
#include "bitstream/base_topology.h"

namespace zerotree::bitstream {

/// One flag per interior edge in the order of their numbers, then one per vertex.
class SharpTagCoding {
 public:
  SharpTagCoding() = default;
  SharpTagCoding(std::vector<BaseEdge> edges, std::uint32_t vertex_count)
      : edges_(std::move(edges)),
        creases_at_(vertex_count, 0),
        edge_flags_(edges_.size(), 0),
        vertex_flags_(vertex_count, 0) {}

  /// The encoder's truth: reads the tags of `base`.
  void set_tags(const BaseTopology& base);
  /// The tags decoded, as BaseTopology holds them.
  void get_tags(BaseTopology& base) const;

  /// Called until it returns true; false means that the coder is starved.
  template <class BitCoder>
  bool code(BitCoder& coder) {
    for (; next_edge_ < edges_.size(); ++next_edge_) {
      const BaseEdge& edge = edges_[next_edge_];
      if (edge.faces[1] == kNone) continue;
      std::uint32_t& first = creases_at_[edge.vertices[0]];
      std::uint32_t& second = creases_at_[edge.vertices[1]];
      // Creases are chains: they go on from vertices that have one already.
      AdaptiveBit& context = crease_[std::min(first, 2u)][std::min(second, 2u)];
      const bool crease = coder.code(edge_flags_[next_edge_] != 0, context);
      if (coder.starved()) return false;
      edge_flags_[next_edge_] = crease ? 1 : 0;
      first += crease ? 1u : 0u;
      second += crease ? 1u : 0u;
    }
    for (; next_vertex_ < vertex_flags_.size(); ++next_vertex_) {
      AdaptiveBit& context = corner_[std::min(creases_at_[next_vertex_], 3u)];
      const bool corner = coder.code(vertex_flags_[next_vertex_] != 0, context);
      if (coder.starved()) return false;
      vertex_flags_[next_vertex_] = corner ? 1 : 0;
    }
    return true;
  }

 private:
  std::vector<BaseEdge> edges_;
  std::vector<std::uint32_t> creases_at_;  // crease edges known at each vertex
  std::vector<std::uint8_t> edge_flags_;
  std::vector<std::uint8_t> vertex_flags_;
  std::size_t next_edge_ = 0;
  std::size_t next_vertex_ = 0;
  std::array<std::array<AdaptiveBit, 3>, 3> crease_;
  std::array<AdaptiveBit, 4> corner_;
};

}  // namespace zerotree::bitstream
