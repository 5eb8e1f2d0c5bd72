// Index arithmetic inside the n x n image of a base edge (see coefficient_layout.h).
//
// A cell (p, q) is the edge from p v + q (u - v) to that point + u, where u runs along the base
// edge and v along side 0's next edge, both one n-th of the base edge long. The formula holds on
// both sides, so neighbours of the same orientation are a step in p and q away everywhere.
#pragma once

#include <cstddef>
#include <cstdint>

namespace zerotree::bitstream {

/// Bits 0..15 of `x` moved to the even bits.
constexpr std::uint32_t spread_bits(std::uint32_t x) {
  x = (x | (x << 8)) & 0x00ff00ffu;
  x = (x | (x << 4)) & 0x0f0f0f0fu;
  x = (x | (x << 2)) & 0x33333333u;
  return (x | (x << 1)) & 0x55555555u;
}

/// The even bits of `x` moved together: the inverse of `spread_bits`.
constexpr std::uint32_t gather_bits(std::uint32_t x) {
  x &= 0x55555555u;
  x = (x | (x >> 1)) & 0x33333333u;
  x = (x | (x >> 2)) & 0x0f0f0f0fu;
  x = (x | (x >> 4)) & 0x00ff00ffu;
  return (x | (x >> 8)) & 0x0000ffffu;
}

/// An edge of level `level` by its base edge and its place in that edge's image.
struct EdgeCell {
  std::uint32_t base_edge, p, q;
};

/// Index of a cell within its level.
constexpr std::size_t cell_index(int level, const EdgeCell& cell) {
  return (std::size_t{cell.base_edge} << (2 * level)) |
         ((spread_bits(cell.p) << 1) | spread_bits(cell.q));
}

constexpr EdgeCell cell_at(int level, std::size_t index) {
  const auto morton = static_cast<std::uint32_t>(index & ((std::size_t{1} << (2 * level)) - 1));
  return {static_cast<std::uint32_t>(index >> (2 * level)), gather_bits(morton >> 1),
          gather_bits(morton)};
}

// Arithmetic on spread numbers, whose bits stand at the even places: an index holds two of them, so
// a step to a neighbour needs no gathering and no spreading.
inline constexpr std::uint32_t kSpreadMask = 0x55555555u;
constexpr std::uint32_t spread_sum(std::uint32_t a, std::uint32_t b) {
  return ((a | ~kSpreadMask) + b) & kSpreadMask;
}
constexpr std::uint32_t spread_difference(std::uint32_t a, std::uint32_t b) {
  return (a - b) & kSpreadMask;
}
/// The largest coordinate of a level, spread.
constexpr std::uint32_t spread_last(int level) {
  return ((std::uint32_t{1} << (2 * level)) - 1) & kSpreadMask;
}

/// A cell with spread coordinates. They compare like plain ones.
struct SpreadCell {
  std::uint32_t base_edge, p, q;
};

constexpr SpreadCell spread_cell_at(int level, std::size_t index) {
  const auto morton = static_cast<std::uint32_t>(index & ((std::size_t{1} << (2 * level)) - 1));
  return {static_cast<std::uint32_t>(index >> (2 * level)), (morton >> 1) & kSpreadMask,
          morton & kSpreadMask};
}

constexpr std::size_t spread_cell_index(int level, const SpreadCell& cell) {
  return (std::size_t{cell.base_edge} << (2 * level)) | ((cell.p << 1) | cell.q);
}

}  // namespace zerotree::bitstream
