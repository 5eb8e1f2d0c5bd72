// Positions of an embedded base, bit plane by bit plane.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory_resource>
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
  PositionPlanes(const BaseTopology& base, int bits,
                 std::pmr::memory_resource* resource = std::pmr::new_delete_resource());

  /// x, y, z per vertex.
  std::span<const std::int32_t> values() const { return values_; }
  int unknown_planes() const { return unknown_; }
  /// Coordinates coded so far in the highest unknown plane.
  std::size_t coded_in_plane() const { return next_; }

  /// Codes the highest unknown plane; called until it returns true, false means that the coder is
  /// starved. `truth` holds the encoder's integers (x, y, z per vertex), a decoder's is empty.
  template <class BitCoder>
  bool code_plane(BitCoder& home, std::span<const std::uint32_t> truth) {
    typename BitCoder::Local coder(home);
    const int plane = unknown_ - 1;
    for (; next_ < values_.size(); ++next_) {
      const bool truly_upper = !truth.empty() && ((truth[next_] >> plane) & 1) != 0;
      const Pull pull = neighbours_pull(next_);
      bool upper = false;
      if (tells_nothing(plane)) {
        upper = coder.code_raw(truly_upper);
      } else {
        upper = coder.code_even(truly_upper != pull.down, context(pull, plane)) != pull.down;
      }
      if (coder.starved()) return false;
      settle(upper, plane, pull);
    }
    next_ = 0;
    unknown_ = plane;
    return true;
  }

 private:
  static constexpr std::size_t kStrengths = 8;

  /// From a coordinate to the mean of its neighbours.
  struct Pull {
    std::int64_t distance = 0;
    bool down = false;
  };

  Pull neighbours_pull(std::size_t coordinate) const;
  bool tells_nothing(int plane) const;
  AdaptiveBit& context(const Pull& pull, int plane);
  void settle(bool upper, int plane, const Pull& pull);

  static constexpr int kSpreadFraction = 8;  // bits of spread_ below the point

  std::int64_t spread() const { return std::max<std::int64_t>(spread_ >> kSpreadFraction, 1); }

  int unknown_ = 0;
  std::size_t next_ = 0;
  std::pmr::vector<std::int32_t> values_;
  // Neighbours of vertex v: ring_[ring_begin_[v]] .. ring_[ring_begin_[v + 1]], two per triangle.
  std::pmr::vector<std::size_t> ring_begin_;
  std::pmr::vector<std::uint32_t> ring_;
  std::int64_t spread_ = 0;  // mean distance of late between a coordinate and its neighbours' mean
  std::array<AdaptiveBit, kStrengths> contexts_;  // by how strongly the neighbours pull
};

}  // namespace zerotree::bitstream
