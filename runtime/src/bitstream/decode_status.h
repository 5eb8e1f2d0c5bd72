// The three answers to bytes.
#pragma once

#include <cstdint>

namespace zerotree::bitstream {

enum class DecodeStatus : std::uint8_t {
  /// Everything the stream holds has been decoded.
  done,
  /// What came so far is right; there is more to come. Never an error.
  more_bytes_wanted,
  /// No continuation of these bytes is a stream that this decoder accepts.
  broken,
};

}  // namespace zerotree::bitstream
