// Writes the header that bitstream/stream_header.h reads.
#pragma once

#include <cstdint>
#include <vector>

#include "bitstream/stream_header.h"

namespace zerotree::encode {

/// The largest step not above `step` that a header can hold; 0 if `step` is too small or no number.
float storable_step(double step);

/// The largest length of an integer not above `length` that a header with this step can hold, or
/// the smallest of all.
float storable_scale(float finest_step, double length);

/// The header's bytes. The fields must be in the ranges that extension-spec/BITSTREAM.md gives;
/// throws std::invalid_argument if step or scale are not storable.
std::vector<std::uint8_t> write_header(const bitstream::StreamHeader& header);

}  // namespace zerotree::encode
