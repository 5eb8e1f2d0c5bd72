// Where a wavelet coefficient lives: the edge forest as Morton-ordered images.
//
// The edges of level l that descend from base edge e are those parallel to it inside its two
// triangles (paper, section 3.4, figure 7). With n = 2^l they form an n x n image of cells (p, q):
// row r = |p - q| counts from the base edge towards the opposite corner, position s = min(p, q)
// runs from the base edge's vertices[0] to vertices[1]; p > q lies in side 0, p < q in side 1 and
// p = q on the base edge itself. A cell's index is (e << 2l) | morton(p, q), the digit of a level
// being 2 pbit + qbit, so the parent of index i is i >> 2 and its children are 4i .. 4i + 3.
// A boundary edge has no side 1: its cells with p < q do not exist and hold zero.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace zerotree::bitstream {

/// The scalar channels of a detail vector in its local frame.
enum Channel : int { kNormal = 0, kTangent1 = 1, kTangent2 = 2, kChannelCount = 3 };

/// Cells of all levels below `level`, per base edge: (4^level - 1) / 3.
constexpr std::size_t cells_below(int level) {
  return ((std::size_t{1} << (2 * level)) - 1) / 3;
}

/// First cell of level `level` in a channel's array: levels are stored one after the other.
constexpr std::size_t level_offset(std::size_t base_edge_count, int level) {
  return base_edge_count * cells_below(level);
}

/// Quantised details of all levels, channel by channel, in the order of `level_offset`.
/// A value is twice the dequantised magnitude in units of the finest step, with its sign: a
/// coefficient whose planes down to b are known is +-(2 m + 2^b), the middle of its interval; one
/// that is not (yet) significant is 0. With all planes known it is +-(2 m + 1), m > 0.
struct CoefficientSet {
  std::size_t base_edge_count = 0;
  int levels = 0;
  std::array<std::vector<std::int32_t>, kChannelCount> channels;
};

}  // namespace zerotree::bitstream
