#include "bitstream/position_planes.h"

#include <bit>
#include <cstdlib>

namespace zerotree::bitstream {

PositionPlanes::PositionPlanes(const BaseTopology& base, int bits,
                               std::pmr::memory_resource* resource)
    : unknown_(bits),
      values_(std::size_t{base.vertex_count} * 3, std::int32_t{1} << bits, resource),
      ring_begin_(std::size_t{base.vertex_count} + 1, 0, resource),
      ring_(base.triangles.size() * 6, resource),
      spread_((std::int64_t{1} << (bits + kSpreadFraction)) / 4) {
  for (const auto& t : base.triangles) {
    for (const std::uint32_t v : t) ring_begin_[v + 1] += 2;
  }
  for (std::size_t v = 0; v < base.vertex_count; ++v) ring_begin_[v + 1] += ring_begin_[v];
  std::pmr::vector<std::size_t> end(ring_begin_.begin(), ring_begin_.end() - 1, resource);
  for (const auto& t : base.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      ring_[end[t[k]]++] = t[(k + 1) % 3];
      ring_[end[t[k]]++] = t[(k + 2) % 3];
    }
  }
}

PositionPlanes::Pull PositionPlanes::neighbours_pull(std::size_t coordinate) const {
  const std::size_t vertex = coordinate / 3, axis = coordinate % 3;
  const auto count = static_cast<std::int64_t>(ring_begin_[vertex + 1] - ring_begin_[vertex]);
  if (count == 0) return {};
  std::int64_t excess = -count * values_[coordinate];
  for (std::size_t i = ring_begin_[vertex]; i < ring_begin_[vertex + 1]; ++i) {
    excess += values_[std::size_t{ring_[i]} * 3 + axis];
  }
  return {std::abs(excess) / count, excess < 0};
}

// The open interval is short against the distances that neighbours keep.
bool PositionPlanes::tells_nothing(int plane) const {
  return (std::int64_t{8} << plane) < spread();
}

// Distances from the neighbours' mean are distributed about as exp(-|x| / spread), so the odds of
// the nearer half depend on the pull over the spread, up to where the pull leaves the interval.
AdaptiveBit& PositionPlanes::context(const Pull& pull, int plane) {
  const std::int64_t reach = std::min(pull.distance, (std::int64_t{3} << plane) / 2);
  const auto eighths = static_cast<std::uint64_t>(reach * 8 / spread());
  const auto strength = static_cast<std::size_t>(std::bit_width(eighths + 1)) - 1;
  return contexts_[std::min(strength, kStrengths - 1)];
}

void PositionPlanes::settle(bool upper, int plane, const Pull& pull) {
  const std::int64_t step = std::int64_t{1} << plane;
  values_[next_] += static_cast<std::int32_t>(upper ? step : -step);
  const std::int64_t left = std::abs(pull.distance + (upper == pull.down ? step : -step));
  spread_ += ((left << kSpreadFraction) - spread_) / 32;
}

}  // namespace zerotree::bitstream
