#include "bitstream/detail_state.h"

#include <algorithm>

namespace zerotree::bitstream {
namespace {

// Weights of a new significance in sixteenths of the threshold, found by experiment.
constexpr int kFaceNeighbour = 13;
constexpr int kRingNeighbour = 5;
constexpr int kParent = 6;
constexpr int kOtherChannel = 3;
constexpr int kFaceLean = 6;
constexpr int kCollinearLean = -2;

void add(std::uint8_t& sum, int weight) {
  sum = static_cast<std::uint8_t>(std::min(255, sum + weight));
}

void add(std::int8_t& sum, int weight) {
  sum = static_cast<std::int8_t>(std::clamp(sum + weight, -127, 127));
}

}  // namespace

DetailState::DetailState(const BaseEdges& base, int levels) {
  coefficients_.base_edge_count = base.edges.size();
  coefficients_.levels = levels;
  const auto edge_and_side = [&](std::uint32_t face, int local) {
    const std::uint32_t e = base.face_edges[face][local];
    const bool first = base.edges[e].faces[0] == face && base.edges[e].local[0] == local;
    return (e << 1) | (first ? 0u : 1u);
  };
  sides_.resize(base.edges.size());
  for (std::size_t e = 0; e < base.edges.size(); ++e) {
    for (int s = 0; s < 2; ++s) {
      const std::uint32_t face = base.edges[e].faces[s];
      sides_[e][s].exists = face != kNone;
      for (int j = 0; j < 3 && face != kNone; ++j) {
        sides_[e][s].edges[j] = edge_and_side(face, (base.edges[e].local[s] + j) % 3);
      }
    }
  }
  const std::size_t cells = level_begin(levels);
  for (int c = 0; c < kChannelCount; ++c) {
    coefficients_.channels[c].assign(cells, 0);
    channels_[c].flags.assign(cells, 0);
    channels_[c].around.assign(cells, 0);
    channels_[c].above.assign(cells, 0);
    channels_[c].open.assign(cells, 0);
  }
  channels_[kNormal].lean.assign(cells, 0);
  mark_absent();
}

std::uint64_t DetailState::memory(std::uint64_t base_edge_count, int levels) {
  constexpr std::uint64_t kPerCell = kChannelCount * (sizeof(std::int32_t) + 4) + 1;
  return base_edge_count * (cells_below(levels) * kPerCell + sizeof(std::array<Side, 2>));
}

void DetailState::mark_absent() {
  for (std::size_t e = 0; e < sides_.size(); ++e) {
    if (sides_[e][1].exists) continue;
    for (int level = 0; level < levels(); ++level) {
      const std::size_t begin = level_begin(level) + (e << (2 * level));
      for (std::size_t m = 0; m < std::size_t{1} << (2 * level); ++m) {
        const EdgeCell cell = cell_at(level, m);
        if (cell.p >= cell.q) continue;
        for (ChannelState& channel : channels_) channel.flags[begin + m] = kAbsent;
      }
    }
  }
}

void DetailState::begin_plane() {
  for (ChannelState& channel : channels_) {
    for (std::uint8_t& f : channel.flags) f = static_cast<std::uint8_t>(f & ~kVisited);
    for (auto* sums : {&channel.around, &channel.above}) {
      for (std::uint8_t& s : *sums) s = static_cast<std::uint8_t>(s > 127 ? 255 : s * 2);
    }
    for (std::int8_t& s : channel.lean) {
      s = static_cast<std::int8_t>(s > 63 ? 127 : s < -63 ? -127 : s * 2);
    }
  }
}

void DetailState::begin_cleanup() {
  for (ChannelState& channel : channels_) {
    const std::uint8_t* flags = channel.flags.data();
    std::uint8_t* open = channel.open.data();
    for (std::size_t i = 0; i < channel.flags.size(); ++i) open[i] = flags[i] == 0;
    for (int level = levels() - 1; level > 0; --level) {
      std::uint8_t* parents = open + level_begin(level - 1);
      const std::uint8_t* children = open + level_begin(level);
      for (std::size_t i = 0; i < level_size(level - 1); ++i, children += 4) {
        parents[i] |= children[0] | children[1] | children[2] | children[3];
      }
    }
  }
}

void DetailState::set_significant(int c, int level, std::size_t index, int plane, bool negative) {
  const std::size_t cell = level_begin(level) + index;
  const std::int32_t magnitude = std::int32_t{3} << plane;
  coefficients_.channels[c][cell] = negative ? -magnitude : magnitude;
  channels_[c].flags[cell] |= kSignificant | kVisited;
  detailed_levels_ = std::max(detailed_levels_, level + 1);

  const int sign = negative ? -1 : 1;
  const EdgeCell where = cell_at(level, index);
  scatter_to_faces(c, level, where, sign);
  scatter_to_ring(c, level, where, sign);
  for (int other = 0; other < kChannelCount; ++other) {
    if (other != c) add(channels_[other].above[cell], kOtherChannel);
  }
  if (level + 1 == levels()) return;
  const std::size_t child = level_begin(level + 1) + 4 * index;
  for (std::size_t k = 0; k < 4; ++k) add(channels_[c].above[child + k], kParent);
}

// The edge lies in row `row` of the image's side, `place` edges after the corner where the side's
// local edge begins. Its two triangles are the one above it, whose corner nearest to each base
// corner has the barycentric coordinates below, and the one under it.
void DetailState::scatter_to_faces(int c, int level, const EdgeCell& cell, int sign) {
  const std::uint32_t last = (1u << level) - 1;
  const auto side_at = [&](int s, std::uint32_t row, std::uint32_t place) {
    const Side& side = sides_[cell.base_edge][s];
    if (!side.exists) return;
    const std::uint32_t rest = last - row - place;
    scatter_to_triangle(c, level, side, {rest, place, row}, 0, sign);
    if (row > 0) scatter_to_triangle(c, level, side, {rest, place, row - 1}, 1, sign);
  };
  if (cell.p >= cell.q) side_at(0, cell.p - cell.q, cell.q);
  // Side 1 runs through the base edge against its direction, so places count from the other end.
  if (cell.p <= cell.q) side_at(1, cell.q - cell.p, last - cell.q);
}

void DetailState::scatter_to_triangle(int c, int level, const Side& side,
                                      std::array<std::uint32_t, 3> corner, std::uint32_t row_offset,
                                      int sign) {
  const std::uint32_t last = (1u << level) - 1;
  for (int j = 1; j < 3; ++j) {
    const std::uint32_t edge = side.edges[j] >> 1;
    const std::uint32_t row = corner[(j + 2) % 3] + row_offset;
    const std::uint32_t place = corner[(j + 1) % 3];
    const EdgeCell neighbour = (side.edges[j] & 1) == 0
                                   ? EdgeCell{edge, place + row, place}
                                   : EdgeCell{edge, last - row - place, last - place};
    const std::size_t i = level_begin(level) + cell_index(level, neighbour);
    add(channels_[c].around[i], kFaceNeighbour);
    if (c == kNormal) add(channels_[c].lean[i], sign * kFaceLean);
  }
}

void DetailState::scatter_to_ring(int c, int level, const EdgeCell& cell, int sign) {
  const std::uint32_t last = (1u << level) - 1;
  const std::size_t begin = level_begin(level);
  const std::uint32_t p_low = cell.p - (cell.p > 0), p_high = std::min(cell.p + 1, last);
  const std::uint32_t q_low = cell.q - (cell.q > 0), q_high = std::min(cell.q + 1, last);
  for (std::uint32_t p = p_low; p <= p_high; ++p) {
    for (std::uint32_t q = q_low; q <= q_high; ++q) {
      if (p == cell.p && q == cell.q) continue;
      const std::size_t i = begin + cell_index(level, {cell.base_edge, p, q});
      add(channels_[c].around[i], kRingNeighbour);
      const bool collinear = p - q == cell.p - cell.q;
      if (c == kNormal && collinear) add(channels_[c].lean[i], sign * kCollinearLean);
    }
  }
}

}  // namespace zerotree::bitstream
