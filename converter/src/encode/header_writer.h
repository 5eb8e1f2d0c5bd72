// Writes the header that bitstream/stream_header.h reads.
#pragma once

#include <cstdint>
#include <vector>

#include "bitstream/stream_header.h"

namespace zerotree::encode {

/// The header's bytes; the fields must be in the ranges that extension-spec/BITSTREAM.md gives.
std::vector<std::uint8_t> write_header(const bitstream::StreamHeader& header);

}  // namespace zerotree::encode
