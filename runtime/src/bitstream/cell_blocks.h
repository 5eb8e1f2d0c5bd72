// Loops over blocks of cells, written so that compilers make vector instructions of them.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace zerotree::bitstream {

/// Cells that are skipped together where nothing happens.
inline constexpr std::size_t kBlockCells = 64;

/// Bits of a cell's flags. A cell with none can become significant in the current pass.
enum CellFlag : std::uint8_t {
  kSignificant = 1,
  kVisited = 2,  ///< coded in this bit plane
  kAbsent = 4,   ///< beyond a boundary, or padding of the last block
  kClosed = 8,   ///< in the cleanup pass: nothing is left to be coded here or below
};

/// Bit i stands for cell i of a block.
using BlockMask = std::uint64_t;

/// Which of the bytes, each 0 or 255, are 255: for any machine.
inline BlockMask gathered_mask(const std::uint8_t (&bytes)[kBlockCells]) {
  // The product moves the lowest bit of byte i to bit 56 + i; no two of its parts meet.
  constexpr std::uint64_t kGather =
      std::endian::native == std::endian::little ? 0x0102040810204080u : 0x8040201008040201u;
  BlockMask mask = 0;
  for (std::size_t k = 0; k < kBlockCells; k += 8) {
    std::uint64_t eight;
    std::memcpy(&eight, bytes + k, 8);
    mask |= (((eight & 0x0101010101010101u) * kGather) >> 56) << k;
  }
  return mask;
}

/// The same, by the instruction that some machines have for it.
inline BlockMask mask_of(const std::uint8_t (&bytes)[kBlockCells]) {
#ifdef __SSE2__
  BlockMask mask = 0;
  for (std::size_t k = 0; k < kBlockCells; k += 16) {
    const __m128i sixteen = _mm_loadu_si128(reinterpret_cast<const __m128i*>(bytes + k));
    mask |= BlockMask{static_cast<std::uint16_t>(_mm_movemask_epi8(sixteen))} << k;
  }
  return mask;
#else
  return gathered_mask(bytes);
#endif
}

/// The cells of a block that are neither coded nor absent and have at least `activity` around and
/// above them.
inline BlockMask likely_cells(const std::uint8_t* flags, const std::uint8_t* around,
                              const std::uint8_t* above, std::uint8_t activity) {
  std::uint8_t hit[kBlockCells];
  for (std::size_t i = 0; i < kBlockCells; ++i) {
    const auto sum = static_cast<std::uint8_t>(around[i] + above[i]);
    const auto overflow = static_cast<std::uint8_t>(sum < around[i] ? 0xff : 0);
    const auto active = static_cast<std::uint8_t>((sum | overflow) >= activity ? 0xff : 0);
    hit[i] = static_cast<std::uint8_t>(flags[i] == 0 ? active : 0);
  }
  return mask_of(hit);
}

/// The cells of a block that became significant in an earlier plane.
inline BlockMask refinable_cells(const std::uint8_t* flags) {
  std::uint8_t hit[kBlockCells];
  for (std::size_t i = 0; i < kBlockCells; ++i) {
    const bool earlier = (flags[i] & (kSignificant | kVisited)) == kSignificant;
    hit[i] = static_cast<std::uint8_t>(earlier ? 0xff : 0);
  }
  return mask_of(hit);
}

/// Doubles a block of sums, up to what a byte holds.
inline void double_sums(std::uint8_t* sums) {
  for (std::size_t i = 0; i < kBlockCells; ++i) {
    sums[i] = static_cast<std::uint8_t>(sums[i] > 127 ? 255 : sums[i] * 2);
  }
}
inline void double_leans(std::int8_t* leans) {
  for (std::size_t i = 0; i < kBlockCells; ++i) {
    const int lean = leans[i];
    leans[i] = static_cast<std::int8_t>(lean > 63 ? 127 : lean < -63 ? -127 : lean * 2);
  }
}

inline void forget_visits(std::uint8_t* flags) {
  for (std::size_t i = 0; i < kBlockCells; ++i) flags[i] &= kSignificant | kAbsent;
}

/// Closes the first `count` cells of a block that are coded or absent and whose four children are
/// closed, which are those with a flag of `child_closed`.
inline void close_cells(std::uint8_t* flags, const std::uint8_t* children, std::size_t count,
                        std::uint8_t child_closed) {
  const std::uint32_t mask = child_closed * 0x01010101u;
  for (std::size_t i = 0; i < count; ++i) {
    std::uint32_t four;
    std::memcpy(&four, children + 4 * i, 4);
    // Flags are below 16, so 15 more carry into the next bit from any but none.
    const bool closed = (((four & mask) + 0x0f0f0f0fu) & 0x10101010u) == 0x10101010u;
    const bool coded = flags[i] != 0;
    flags[i] = static_cast<std::uint8_t>(flags[i] | (closed && coded ? kClosed : 0));
  }
}

}  // namespace zerotree::bitstream
