// Crease and corner flags of a base.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "bitstream/adaptive_bit.h"
#include "bitstream/base_edges.h"
#include "bitstream/base_topology.h"

namespace zerotree::bitstream {

/// One flag per interior edge in the order of their numbers, then one per vertex.
class SharpTagCoding {
 public:
  SharpTagCoding() = default;
  /// The edges must stay.
  SharpTagCoding(std::span<const BaseEdge> edges, std::uint32_t vertex_count,
                 std::pmr::memory_resource* resource = std::pmr::new_delete_resource());

  /// The encoder's truth: reads the tags of `base`.
  void set_tags(const BaseTopology& base);
  /// The tags decoded, as BaseTopology holds them. Allocates only what `base` has not reserved.
  void get_tags(BaseTopology& base) const;

  /// Called until it returns true; false means that the coder is starved.
  template <class BitCoder>
  bool code(BitCoder& coder) {
    for (; next_edge_ < edges_.size(); ++next_edge_) {
      const BaseEdge& edge = edges_[next_edge_];
      if (edge.faces[1] == kNone) continue;
      const auto [less, more] =
          std::minmax({situation(edge.vertices[0]), situation(edge.vertices[1])});
      const bool crease = coder.code(edge_flags_[next_edge_] != 0, crease_[less][more]);
      if (coder.starved()) return false;
      edge_flags_[next_edge_] = crease ? 1 : 0;
      for (const std::uint32_t v : edge.vertices) {
        --edges_left_[v];
        creases_at_[v] += crease ? 1u : 0u;
      }
    }
    for (; next_vertex_ < vertex_flags_.size(); ++next_vertex_) {
      AdaptiveBit& context = corner_[std::min(creases_at_[next_vertex_], 4u)];
      const bool corner = coder.code(vertex_flags_[next_vertex_] != 0, context);
      if (coder.starved()) return false;
      vertex_flags_[next_vertex_] = corner ? 1 : 0;
    }
    return true;
  }

 private:
  static constexpr std::size_t kSituations = 5;

  /// Creases are chains: one that has come to a vertex goes on there, the surer the fewer edges are
  /// left for it.
  std::size_t situation(std::uint32_t vertex) const {
    if (creases_at_[vertex] == 0) return 0;
    if (creases_at_[vertex] > 1) return 2;
    return edges_left_[vertex] > 3 ? 1 : edges_left_[vertex] > 1 ? 3 : 4;
  }

  std::span<const BaseEdge> edges_;
  std::pmr::vector<std::uint32_t> creases_at_;  // crease edges known at each vertex
  std::pmr::vector<std::uint32_t> edges_left_;  // interior edges not yet coded at each vertex
  std::pmr::vector<std::uint8_t> edge_flags_;
  std::pmr::vector<std::uint8_t> vertex_flags_;
  std::size_t next_edge_ = 0;
  std::size_t next_vertex_ = 0;
  std::array<std::array<AdaptiveBit, kSituations>, kSituations> crease_;
  std::array<AdaptiveBit, 5> corner_;
};

}  // namespace zerotree::bitstream
