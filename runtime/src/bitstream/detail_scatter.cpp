// What a new significance tells its neighbours.
#include "bitstream/detail_state.h"

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

void add_around(const ChannelCells& cells, std::size_t index, int weight) {
  add(cells.around[index], weight);
  cells.touched[index / kBlockCells] = 1;
}

void add_above(const ChannelCells& cells, std::size_t index, int weight) {
  add(cells.above[index], weight);
  cells.touched[index / kBlockCells] = 1;
}

struct Steps {
  int first, last;  // of -1, 0, 1, counted from 0
};

// Steps in q change one half of the index's bits, steps in p the other.
template <bool kNormalChannel>
inline void scatter_to_ring(const ChannelCells& cells, std::size_t image, const SpreadCell& cell,
                            Steps p_steps, Steps q_steps, int sign) {
  const std::array<std::uint32_t, 3> rows = {spread_difference(cell.p, 1) << 1, cell.p << 1,
                                             spread_sum(cell.p, 1) << 1};
  const std::array<std::uint32_t, 3> columns = {spread_difference(cell.q, 1), cell.q,
                                                spread_sum(cell.q, 1)};
  for (int i = p_steps.first; i <= p_steps.last; ++i) {
    for (int k = q_steps.first; k <= q_steps.last; ++k) {
      if (i == 1 && k == 1) continue;
      const std::size_t index = image + (rows[i] | columns[k]);
      add_around(cells, index, kRingNeighbour);
      // On one line with the cell: p - q is the same.
      if (kNormalChannel && i == k) add(cells.lean[index], sign * kCollinearLean);
    }
  }
}

template <bool kNormalChannel>
void scatter_to_ring(const ChannelCells& cells, int level, const SpreadCell& cell, int sign) {
  const std::uint32_t last = spread_last(level);
  const std::size_t image = std::size_t{cell.base_edge} << (2 * level);
  const auto steps = [last](std::uint32_t x) { return Steps{x == 0 ? 1 : 0, x == last ? 1 : 2}; };
  const Steps p_steps = steps(cell.p), q_steps = steps(cell.q);
  if (p_steps.last - p_steps.first + q_steps.last - q_steps.first == 4) {  // so it is unrolled
    scatter_to_ring<kNormalChannel>(cells, image, cell, {0, 2}, {0, 2}, sign);
  } else {
    scatter_to_ring<kNormalChannel>(cells, image, cell, p_steps, q_steps, sign);
  }
}

}  // namespace

void DetailState::set_significant(int c, int level, std::size_t index, int plane, bool negative) {
  set_value(c, level, index, plane, negative);
  note_change(level);
  const ChannelCells cells = levels_[level].cells[c];
  cells.flags[index] |= kSignificant | kVisited;
  cells.touched[index / kBlockCells] = 1;
  const int sign = negative ? -1 : 1;
  c == kNormal ? scatter<true>(cells, level, index, sign)
               : scatter<false>(cells, level, index, sign);
  for (int other = 0; other < kChannelCount; ++other) {
    if (other == c) continue;
    activate(other, level);
    add_above(levels_[level].cells[other], index, kOtherChannel);
  }
  if (level + 1 == levels()) return;
  activate(c, level + 1);
  const ChannelCells children = levels_[level + 1].cells[c];
  for (std::size_t k = 0; k < 4; ++k) add(children.above[4 * index + k], kParent);
  children.touched[4 * index / kBlockCells] = 1;
}

void DetailState::set_value(int c, int level, std::size_t index, int plane, bool negative) {
  LevelValues& values = levels_[level].values[c];
  if (!has_details(c, level)) {
    values.clear();
    detailed_[c] |= std::uint32_t{1} << level;
  }
  if (plane >= LevelValues::kNarrowPlanes && !values.is_wide()) values.widen();
  const std::int32_t magnitude = std::int32_t{3} << plane;
  values.set(index, negative ? -magnitude : magnitude);
}

template <bool kNormalChannel>
void DetailState::scatter(const ChannelCells& cells, int level, std::size_t index, int sign) {
  const SpreadCell where = spread_cell_at(level, index);
  scatter_to_faces<kNormalChannel>(cells, level, where, sign);
  scatter_to_ring<kNormalChannel>(cells, level, where, sign);
}

// The edge lies in row `row` of the image's side, `place` edges after the corner where the side's
// local edge begins. Its two triangles are the one above it, whose corner nearest to each base
// corner has the barycentric coordinates below, and the one under it. All numbers are spread.
template <bool kNormalChannel>
void DetailState::scatter_to_faces(const ChannelCells& cells, int level, const SpreadCell& cell,
                                   int sign) {
  const std::uint32_t last = spread_last(level);
  const auto side_at = [&](int s, std::uint32_t row, std::uint32_t place) {
    const Side& side = sides_[cell.base_edge][s];
    if (!side.exists) return;
    const std::uint32_t rest = spread_difference(spread_difference(last, row), place);
    scatter_to_triangle<kNormalChannel>(cells, level, side, {rest, place, row}, 0, sign);
    if (row == 0) return;
    const std::uint32_t under = spread_difference(row, 1);
    scatter_to_triangle<kNormalChannel>(cells, level, side, {rest, place, under}, 1, sign);
  };
  if (cell.p >= cell.q) side_at(0, spread_difference(cell.p, cell.q), cell.q);
  // Side 1 runs through the base edge against its direction, so places count from the other end.
  if (cell.p <= cell.q) {
    side_at(1, spread_difference(cell.q, cell.p), spread_difference(last, cell.q));
  }
}

template <bool kNormalChannel>
void DetailState::scatter_to_triangle(const ChannelCells& cells, int level, const Side& side,
                                      std::array<std::uint32_t, 3> corner, std::uint32_t row_offset,
                                      int sign) {
  const std::uint32_t last = spread_last(level);
  for (int j = 1; j < 3; ++j) {
    const std::uint32_t edge = side.edges[j] >> 1;
    const std::uint32_t row = spread_sum(corner[(j + 2) % 3], row_offset);
    const std::uint32_t place = corner[(j + 1) % 3];
    const std::uint32_t end = spread_sum(place, row);
    const SpreadCell neighbour =
        (side.edges[j] & 1) == 0
            ? SpreadCell{edge, end, place}
            : SpreadCell{edge, spread_difference(last, end), spread_difference(last, place)};
    const std::size_t i = cell_index(level, neighbour);
    add_around(cells, i, kFaceNeighbour);
    if (kNormalChannel) add(cells.lean[i], sign * kFaceLean);
  }
}

}  // namespace zerotree::bitstream
