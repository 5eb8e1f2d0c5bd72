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

// Steps in q change one half of the index's bits, steps in p the other. A neighbour beyond the
// image is the cell's own row or column with no weight: that costs less than a jump that few
// foresee.
template <bool kNormalChannel>
inline void scatter_to_ring(const ChannelCells& cells, int level, const SpreadCell& cell,
                            int sign) {
  const std::uint32_t last = spread_last(level);
  const std::size_t image = std::size_t{cell.base_edge} << (2 * level);
  const bool p_exists[3] = {cell.p != 0, true, cell.p != last};
  const bool q_exists[3] = {cell.q != 0, true, cell.q != last};
  const std::uint32_t rows[3] = {spread_difference(cell.p, p_exists[0]) << 1, cell.p << 1,
                                 spread_sum(cell.p, p_exists[2]) << 1};
  const std::uint32_t columns[3] = {spread_difference(cell.q, q_exists[0]), cell.q,
                                    spread_sum(cell.q, q_exists[2])};
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) {
      if (i == 1 && k == 1) continue;
      const std::size_t index = image + (rows[i] | columns[k]);
      const int exists = p_exists[i] && q_exists[k];
      add(cells.around[index], exists * kRingNeighbour);
      // On one line with the cell: p - q is the same.
      if (kNormalChannel && i == k) add(cells.lean[index], exists * sign * kCollinearLean);
      // The corners lie in all the blocks that the ring lies in.
      if (i != 1 && k != 1) cells.touched[index / kBlockCells] = 1;
    }
  }
}

}  // namespace

// A small triangle by the image side that it lies in: the barycentric coordinates of its corner
// nearest to each base corner, but the third one less than that by `row_offset`. All are spread.
struct DetailState::SmallTriangle {
  std::uint32_t rest, place, row, row_offset;
};

void DetailState::set_significant(int c, int level, std::size_t index, int plane, bool negative) {
  set_value(c, level, index, plane, negative);
  note_change(level);
  const ChannelCells cells = levels_[level].cells[c];
  cells.flags[index] |= kSignificant | kVisited;
  cells.touched[index / kBlockCells] = 1;
  const int sign = 1 - 2 * int{negative};
  c == kNormal ? scatter<true>(cells, level, index, sign)
               : scatter<false>(cells, level, index, sign);
  for (int other = 0; other < kChannelCount; ++other) {
    if (other == c) continue;
    activate(other, level);
    const ChannelCells others = levels_[level].cells[other];
    add(others.above[index], kOtherChannel);
    others.touched[index / kBlockCells] = 1;
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
  values.set(index, (1 - 2 * int{negative}) * (std::int32_t{3} << plane));
}

// The edge lies in row `row` of the image's side, `place` edges after the corner where the side's
// local edge begins. Its two triangles are the one above it and the one under it, which for an edge
// on the base edge is the first one of the other side.
template <bool kNormalChannel>
void DetailState::scatter(const ChannelCells& cells, int level, std::size_t index, int sign) {
  const SpreadCell cell = spread_cell_at(level, index);
  scatter_to_ring<kNormalChannel>(cells, level, cell, sign);
  const std::uint32_t last = spread_last(level);
  const bool second = cell.p < cell.q;
  const std::uint32_t row = spread_difference(second ? cell.q : cell.p, second ? cell.p : cell.q);
  // Side 1 runs through the base edge against its direction, so places count from the other end.
  const std::uint32_t place = cell.q ^ (second ? last : 0);
  const std::uint32_t rest = spread_difference(last ^ row, place);
  const std::array<Side, 2>& sides = sides_[cell.base_edge];
  const auto scatter_in = [&](const Side& side, const SmallTriangle& triangle) {
    if (side.exists()) scatter_to_triangle<kNormalChannel>(cells, level, side, triangle, sign);
  };
  scatter_in(sides[second ? 1 : 0], {rest, place, row, 0});
  if (row == 0) {
    scatter_in(sides[1], {place, rest, 0, 0});
  } else {
    scatter_in(sides[second ? 1 : 0], {rest, place, spread_difference(row, 1), 1});
  }
}

template <bool kNormalChannel>
inline void DetailState::scatter_to_triangle(const ChannelCells& cells, int level, const Side& side,
                                             const SmallTriangle& triangle, int sign) {
  const std::uint32_t last = spread_last(level);
  const std::array<std::uint32_t, 3> corner = {triangle.rest, triangle.place, triangle.row};
  for (int j = 1; j < 3; ++j) {
    const std::uint32_t seen = side.next[j - 1], edge = seen >> 1;
    const std::uint32_t row = spread_sum(corner[(j + 2) % 3], triangle.row_offset);
    const std::uint32_t place = corner[(j + 1) % 3];
    // A coordinate counted from the other end is its complement.
    const std::uint32_t turn = last & (0u - (seen & 1));
    const std::uint32_t end = spread_sum(place, row);
    const std::size_t i = spread_cell_index(level, {edge, end ^ turn, place ^ turn});
    add(cells.around[i], kFaceNeighbour);
    if (kNormalChannel) add(cells.lean[i], sign * kFaceLean);
    cells.touched[i / kBlockCells] = 1;
  }
}

}  // namespace zerotree::bitstream
