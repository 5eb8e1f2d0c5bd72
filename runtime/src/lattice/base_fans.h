// The irregular part of the surface: base edges with the triangles beside them, and base vertices
// with the edges around them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "bitstream/base_edges.h"
#include "bitstream/base_topology.h"

namespace zerotree::surface {

// There are millions of the following where a base is large: they are packed.

/// A base edge, running as the stream has it: with its left triangle's side and against its right
/// one's.
struct BaseStrip {
  /// Side k of a triangle begins at its corner k.
  struct Side {
    std::uint32_t face;  ///< right of a boundary: bitstream::kNone
    std::uint32_t side;
  };
  std::array<std::uint32_t, 2> faces;
  std::array<std::uint8_t, 2> sides;
  bool is_sharp;  ///< a crease or a boundary

  Side left() const { return {faces[0], sides[0]}; }
  Side right() const { return {faces[1], sides[1]}; }
  bool is_boundary() const { return faces[1] == bitstream::kNone; }
};

/// An edge at a base vertex: the strip, and whether the vertex is its head.
class BaseSpoke {
 public:
  BaseSpoke(std::uint32_t strip, bool is_head) : packed_((strip << 1) | (is_head ? 1u : 0u)) {}
  std::uint32_t strip() const { return packed_ >> 1; }
  bool is_head() const { return (packed_ & 1) != 0; }

 private:
  std::uint32_t packed_;
};

/// A triangle's corner at a base vertex.
struct BaseCorner {
  std::uint32_t face, corner;
};

/// Weights of a base vertex and, times the spokes, of its neighbours: the same at every level.
struct FanWeights {
  float child, position, tangent1, tangent2;
  /// Of a spoke: what of its detail lifts the vertex (surface/local_filter.h).
  float lift;
};

/// Vertices whose fans are alike share their weights: most vertices of a large base are regular.
/// 12 bytes per edge and 32 per vertex.
class BaseFans {
 public:
  /// `topology` with its tags, and its edges. Throws std::invalid_argument as make_loop_refiner.
  BaseFans(const bitstream::BaseTopology& topology, const std::vector<bitstream::BaseEdge>& edges,
           std::pmr::memory_resource* memory);

  struct View {
    FanWeights vertex;  ///< its `lift` means nothing
    float dip_per_lift;
    std::span<const BaseSpoke> spokes;  ///< counter-clockwise
    std::span<const FanWeights> weights;
  };

  std::size_t vertex_count() const { return weights_of_.size(); }
  View fan(std::size_t vertex) const;
  std::span<const BaseStrip> strips() const { return strips_; }
  /// The corner between a spoke and the next one. Of the last one of a boundary vertex there is
  /// none: its face is bitstream::kNone. The first one of any vertex has one.
  BaseCorner corner_after(const BaseSpoke& spoke) const {
    const BaseStrip& strip = strips_[spoke.strip()];
    const auto [face, side] = spoke.is_head() ? strip.right() : strip.left();
    return {face, side};
  }

 private:
  /// What fans that are alike share; weights of spokes from `first_spoke` on.
  struct SharedWeights {
    FanWeights vertex;
    float dip_per_lift;
    std::uint32_t first_spoke;
  };
  class Builder;

  std::pmr::vector<BaseStrip> strips_;
  std::pmr::vector<std::uint32_t> spoke_begin_;  // by vertex, and one beyond
  std::pmr::vector<BaseSpoke> spokes_;
  std::pmr::vector<std::uint32_t> weights_of_;  // by vertex
  std::pmr::vector<SharedWeights> weights_;
  std::pmr::vector<FanWeights> spoke_weights_;
};

}  // namespace zerotree::surface
