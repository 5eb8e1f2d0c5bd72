// Positions of an embedded base, bit plane by bit plane.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "bitstream/adaptive_bit.h"
#include "bitstream/base_topology.h"
#include "bitstream/stream_header.h"

namespace zerotree::bitstream {

/// What the value of a coordinate stands for: a whole number of half integers' lengths, so that the
/// same integers are the same point on every machine.
inline float dequantise_coordinate(const PositionQuantisation& quantisation, std::size_t axis,
                                   std::int32_t value) {
  const std::int64_t halves =
      quantisation.origin[axis] * (std::int64_t{2} << origin_shift(quantisation.bits)) + value;
  return static_cast<float>(static_cast<double>(halves) * (0.5 * double{quantisation.scale}));
}

/// Integer coordinates of which the upper planes are known. A value is twice the integer, at the
/// middle of what the unknown planes leave open: 2 q + 2^unknown.
class PositionPlanes {
 public:
  PositionPlanes() = default;
  /// `bits` per coordinate; triangles must name vertices below vertex_count.
  PositionPlanes(const BaseTopology& base, int bits);

  /// x, y, z per vertex.
  std::span<const std::int32_t> values() const { return values_; }
  int unknown_planes() const { return unknown_; }

  /// Codes the highest unknown plane; called until it returns true, false means that the coder is
  /// starved. `truth` holds the encoder's integers (x, y, z per vertex), a decoder's is empty.
  template <class BitCoder>
  bool code_plane(BitCoder& coder, std::span<const std::uint32_t> truth) {
    const int plane = unknown_ - 1;
    for (; next_ < values_.size(); ++next_) {
      const bool bit = !truth.empty() && ((truth[next_] >> plane) & 1) != 0;
      const bool upper = coder.code(bit, context(next_, plane));
      if (coder.starved()) return false;
      values_[next_] += upper ? std::int32_t{1} << plane : -(std::int32_t{1} << plane);
    }
    next_ = 0;
    unknown_ = plane;
    return true;
  }

 private:
  static constexpr int kOffsets = 12;  // of the expected value, in quarters of the open half
  static constexpr int kPlanes = 4;    // the first ones have statistics of their own

  AdaptiveBit& context(std::size_t coordinate, int plane);

  int bits_ = 0;
  int unknown_ = 0;
  std::size_t next_ = 0;
  std::vector<std::int32_t> values_;
  // Neighbours of vertex v: ring_[ring_begin_[v]] .. ring_[ring_begin_[v + 1]], two per triangle.
  std::vector<std::uint32_t> ring_begin_;
  std::vector<std::uint32_t> ring_;
  std::array<std::array<AdaptiveBit, kOffsets>, kPlanes> contexts_;
};

}  // namespace zerotree::bitstream
