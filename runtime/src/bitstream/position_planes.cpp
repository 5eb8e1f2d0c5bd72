#include "bitstream/position_planes.h"

namespace zerotree::bitstream {

PositionPlanes::PositionPlanes(const BaseTopology& base, int bits)
    : bits_(bits),
      unknown_(bits),
      values_(std::size_t{base.vertex_count} * 3, std::int32_t{1} << bits),
      ring_begin_(std::size_t{base.vertex_count} + 1, 0),
      ring_(base.triangles.size() * 6) {
  for (const auto& t : base.triangles) {
    for (const std::uint32_t v : t) ring_begin_[v + 1] += 2;
  }
  for (std::size_t v = 0; v < base.vertex_count; ++v) ring_begin_[v + 1] += ring_begin_[v];
  std::vector<std::uint32_t> end(ring_begin_.begin(), ring_begin_.end() - 1);
  for (const auto& t : base.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      ring_[end[t[k]]++] = t[(k + 1) % 3];
      ring_[end[t[k]]++] = t[(k + 2) % 3];
    }
  }
}

// Neighbours are close together, so where their mean lies tells which half is likelier: much in
// the first planes, nothing in the last ones. Known are this plane's bits of earlier vertices.
AdaptiveBit& PositionPlanes::context(std::size_t coordinate, int plane) {
  const std::size_t vertex = coordinate / 3, axis = coordinate % 3;
  const std::int64_t count = ring_begin_[vertex + 1] - ring_begin_[vertex];
  std::int64_t excess = -count * values_[coordinate];
  for (std::uint32_t i = ring_begin_[vertex]; i < ring_begin_[vertex + 1]; ++i) {
    excess += values_[std::size_t{ring_[i]} * 3 + axis];
  }
  // Half the open interval is 2^(plane + 1) long in units of the values.
  const std::int64_t quarters =
      count == 0 ? 0 : excess * 4 / (count << (plane + 1)) + (excess < 0 ? -1 : 0);
  constexpr std::int64_t kMiddle = kOffsets / 2;
  const auto offset =
      static_cast<std::size_t>(std::clamp<std::int64_t>(quarters + kMiddle, 0, kOffsets - 1));
  return contexts_[static_cast<std::size_t>(std::min(bits_ - 1 - plane, kPlanes - 1))][offset];
}

}  // namespace zerotree::bitstream
