// Stream contents made in code.
#pragma once

#include <cstdint>
#include <vector>

#include "bitstream/stream_decoder.h"
#include "encode/stream_encoder.h"
#include "shapes.h"

namespace zerotree::test {

/// The shape as a base mesh in canonical order.
bitstream::BaseTopology canonical_base(const Shape& shape);

/// A stream of `base` with random positions and no details (all zero) at `levels` levels. An
/// external one is bound to `external_positions(base)`.
encode::StreamContent empty_content(const bitstream::BaseTopology& base, int levels, bool embedded,
                                    std::uint32_t seed);
std::vector<float> external_positions(const bitstream::BaseTopology& base);

/// Fills existing cells: a share `density` of them, of random sign and of magnitudes below
/// 2^bits, small ones more often.
void add_random_details(encode::StreamContent& content, double density, int bits,
                        std::uint32_t seed);

/// Laplacian details as those of a smooth surface: the mean magnitude is `finest_mean` at the
/// finest level, `growth` times more per coarser level, and half of that in tangents.
void add_laplacian_details(encode::StreamContent& content, double finest_mean, double growth,
                           std::uint32_t seed);

/// A decoder for such a stream.
bitstream::StreamDecoder decoder_for(const encode::StreamContent& content);

}  // namespace zerotree::test
