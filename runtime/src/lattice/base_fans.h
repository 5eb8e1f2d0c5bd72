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

/// A base edge, running as the stream has it: with its left triangle's side and against its right
/// one's.
struct BaseStrip {
  struct Side {
    std::uint32_t face;  ///< right of a boundary: bitstream::kNone
    std::uint32_t side;
  };
  Side left, right;
  std::array<std::uint32_t, 2> vertices;
  /// Its number in OpenSubdiv's base level, and whether it runs the other way there.
  std::uint32_t refiner_edge;
  bool is_reversed;
  bool is_sharp;  ///< a crease or a boundary

  bool is_boundary() const { return right.face == bitstream::kNone; }
};

/// An edge at a base vertex: the strip, and whether the vertex is its head.
struct BaseSpoke {
  std::uint32_t strip;
  bool is_head;
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
    std::span<const BaseCorner> corners;
  };

  std::size_t vertex_count() const { return vertex_weights_.size(); }
  View fan(std::size_t vertex) const;
  std::span<const BaseStrip> strips() const { return strips_; }

 private:
  std::pmr::vector<BaseStrip> strips_;
  std::pmr::vector<FanWeights> vertex_weights_;
  std::pmr::vector<float> dips_per_lift_;
  std::pmr::vector<std::uint32_t> spoke_begin_, corner_begin_;
  std::pmr::vector<BaseSpoke> spokes_;
  std::pmr::vector<FanWeights> spoke_weights_;
  std::pmr::vector<BaseCorner> corners_;
};

}  // namespace zerotree::surface
