// The first bytes of a stream: what it holds and how large it will be.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "bitstream/decode_status.h"

namespace zerotree::bitstream {

inline constexpr std::array<std::uint8_t, 2> kMagic = {'Z', 'T'};
inline constexpr std::uint8_t kFormatVersion = 1;

/// The third byte: version in the low four bits, two flags, the transform in the top two bits.
inline constexpr std::uint8_t kVersionMask = 0x0f;
inline constexpr std::uint8_t kFlagExternalBase = 0x10;
inline constexpr std::uint8_t kFlagSharpTags = 0x20;
inline constexpr int kTransformShift = 6;

/// What the format allows, whatever a reader's own limits are.
inline constexpr int kMostLevels = 14;
inline constexpr int kMostPlanes = 30;
inline constexpr int kMostPositionBits = 28;
inline constexpr int kMostTangentRatioLog2 = 15;
inline constexpr std::uint32_t kMostTransform = 3;
inline constexpr std::uint32_t kMostFaces = 0x3fffffff;

/// No header is longer.
inline constexpr std::size_t kMostHeaderBytes = 40;

/// How an embedded base's positions are quantised; see `dequantise_coordinate`.
struct PositionQuantisation {
  /// Lowest corner of the cube of integers, in units of 2^origin_shift(bits) integers.
  std::array<std::int32_t, 3> origin{};
  /// Length of an integer; one of the 256 lengths that `scale_of` gives.
  float scale = 1.0f;
  /// Bits per coordinate.
  int bits = 0;
  /// Planes that come before the details; each further plane comes with a plane of details.
  int initial_planes = 0;
};

/// The origin stands on a grid of sixteenths of the cube, so that its numbers are small.
inline int origin_shift(int position_bits) {
  return std::max(position_bits - 4, 0);
}

/// The header's byte for the length of an integer: step * (4 + code mod 4) / 4 * 2^(code / 4 - 32).
/// A length so bound to the step needs no exponent of its own.
float scale_of(float finest_step, std::uint8_t code);

struct StreamHeader {
  /// The base mesh is not in the stream; `base_hash` tells whether the right one is at hand.
  bool external_base = false;
  /// Some edges are creases or some vertices are corners.
  bool has_sharp_tags = false;
  /// A surface::WaveletTransform.
  std::uint32_t transform = 0;
  int levels = 0;
  /// Of the base. Those of an external one are not in the stream; its decoder fills them in.
  std::uint32_t vertex_count = 0;
  std::uint32_t face_count = 0;
  /// Bit planes of the largest detail.
  int planes = 0;
  /// Step of the normal details of basis norm and edge weight 1, in the unit of the positions. A
  /// bfloat16: the lower half of the float is zero.
  float finest_step = 1.0f;
  /// Tangential details have a step 2^this times as long.
  int tangent_ratio_log2 = 2;
  PositionQuantisation positions;  ///< embedded base only
  std::uint32_t base_hash = 0;     ///< external base only
};

/// What a reader is willing to decode. A stream beyond is refused before memory is taken.
struct Limits {
  /// Vertices of the finest level.
  std::uint64_t max_vertices = std::uint64_t{1} << 27;
  int max_levels = kMostLevels;
  /// Bytes the decoder holds for the base, the coefficients and their coding state.
  std::uint64_t max_memory = std::uint64_t{2} << 30;
};

struct HeaderResult {
  /// done, more_bytes_wanted or broken.
  DecodeStatus status = DecodeStatus::more_bytes_wanted;
  /// Why it is broken, as a sentence.
  std::string reason;
  /// Bytes of the header, if done.
  std::size_t size = 0;
};

/// Whether a reader with these limits takes a stream with this header, by the counts in it: empty,
/// or a sentence that says which limit it breaks.
std::string check_size(const StreamHeader& header, const Limits& limits);

/// Reads a header off the front of `bytes`. Every field is checked against the format and, but for
/// the counts of an external base, against `limits`. Any bytes are safe; nothing is allocated.
HeaderResult read_header(std::span<const std::uint8_t> bytes, const Limits& limits,
                         StreamHeader& header);

}  // namespace zerotree::bitstream
