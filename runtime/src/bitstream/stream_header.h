// The first bytes of a stream: what it holds and how large it will be.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "bitstream/decode_status.h"

namespace zerotree::bitstream {

inline constexpr std::array<std::uint8_t, 2> kMagic = {'Z', 'T'};
inline constexpr std::uint8_t kFormatVersion = 1;

/// Bits of the header's flag byte; the others are zero.
inline constexpr std::uint8_t kFlagExternalBase = 1;
inline constexpr std::uint8_t kFlagSharpTags = 2;

/// What the format allows, whatever a reader's own limits are.
inline constexpr int kMostLevels = 14;
inline constexpr int kMostPlanes = 30;
inline constexpr int kMostPositionBits = 28;
inline constexpr int kMostTangentRatioLog2 = 15;

/// How an embedded base's positions are quantised: coordinate = origin + value / 2 * scale, where
/// `value` is twice the integer's midpoint (see `PositionPlanes`).
struct PositionQuantisation {
  std::array<float, 3> origin{};
  float scale = 1.0f;
  /// Bits per coordinate.
  int bits = 0;
  /// Planes that come before the details; each further plane comes with a plane of details.
  int initial_planes = 0;
};

struct StreamHeader {
  /// The base mesh is not in the stream; `base_hash` tells whether the right one is at hand.
  bool external_base = false;
  /// Some edges are creases or some vertices are corners.
  bool has_sharp_tags = false;
  /// A surface::WaveletTransform.
  std::uint32_t transform = 0;
  int levels = 0;
  std::uint32_t vertex_count = 0;
  std::uint32_t face_count = 0;
  /// Bit planes of the largest detail.
  int planes = 0;
  /// Step of the normal details of basis norm and edge weight 1, in the unit of the positions.
  float finest_step = 1.0f;
  /// Tangential details have a step 2^this times as long.
  int tangent_ratio_log2 = 2;
  PositionQuantisation positions;        ///< embedded base only
  std::uint32_t connectivity_bytes = 0;  ///< embedded base only
  std::uint64_t base_hash = 0;           ///< external base only
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

/// Reads a header off the front of `bytes`. Every field is checked against the format and against
/// `limits`. Any bytes are safe; nothing is allocated.
HeaderResult read_header(std::span<const std::uint8_t> bytes, const Limits& limits,
                         StreamHeader& header);

}  // namespace zerotree::bitstream
