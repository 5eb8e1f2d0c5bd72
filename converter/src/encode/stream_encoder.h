// The pure core of the encoder: integers in, bytes out.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "bitstream/base_topology.h"
#include "bitstream/coded_passes.h"
#include "bitstream/coefficient_layout.h"
#include "bitstream/stream_header.h"

namespace zerotree::encode {

/// Everything a stream says, quantised.
struct StreamContent {
  /// Transform, levels, step, tangential ratio, external or not, and for an embedded base the
  /// quantisation of its positions or for an external one its hash. Counts, number of planes
  /// and sharp tag flag are filled in by the encoder.
  bitstream::StreamHeader header;
  /// An embedded base must be in canonical order (bitstream::canonical_base_order).
  bitstream::BaseTopology base;
  /// Embedded base only: x, y, z per vertex, each of header.positions.bits bits.
  std::vector<std::uint32_t> positions;
  /// Final midpoint values; cells that do not exist are 0.
  bitstream::CoefficientSet coefficients;
};

/// Where a pass of the stream ends: a prefix of `bytes` bytes decodes it completely.
struct PassEnd {
  std::size_t bytes;
  /// Details' bit plane; before the first one the number of planes.
  int plane;
  bitstream::Pass pass;
};

struct StreamBytes {
  std::vector<std::uint8_t> bytes;
  /// In the order of the stream.
  std::vector<PassEnd> pass_ends;
};

/// Bit planes of the largest coefficient: 0 if all are zero.
int count_planes(const bitstream::CoefficientSet& coefficients);

/// Codes `content`. Deterministic; one thread; memory as the decoder's and two bytes per
/// coefficient. Throws Error (refused_topology) if the base is not a canonically ordered manifold
/// and std::invalid_argument if sizes or values contradict each other.
StreamBytes encode_stream(const StreamContent& content);

}  // namespace zerotree::encode
