// Binary range decoder that knows what it does not know.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "bitstream/adaptive_bit.h"

namespace zerotree::bitstream {

/// Decodes the decisions of a byte sequence of which only a prefix may be there.
///
/// Bytes that are missing count as zero in the code register and as ones in a mask above it: the
/// true code lies in [code, code + mask]. A decision is taken only if it is the same over that
/// whole interval; otherwise the decoder is `starved`: the call returned false, changed nothing,
/// and must be repeated after `set_bytes` brought more. So decoding in pieces takes exactly the
/// decisions of decoding at once. Any bytes are safe.
class RangeDecoder {
 public:
  RangeDecoder() = default;
  explicit RangeDecoder(std::span<const std::uint8_t> bytes) { set_bytes(bytes); }

  /// The sequence as far as it is known; begins with what earlier calls gave. The bytes are
  /// neither copied nor owned and must stay until the next call.
  void set_bytes(std::span<const std::uint8_t> bytes) {
    bytes_ = bytes;
    starved_ = false;
    while (missing_bits_ > 0 && next_ < bytes_.size()) {
      missing_bits_ -= 8;
      code_ += static_cast<std::uint64_t>(bytes_[next_++]) << missing_bits_;
    }
  }

  /// Decodes one bit; the argument is there for the encoder's sake.
  bool code(bool /*bit*/, AdaptiveBit& context) {
    const std::uint64_t bound = (range_ * context.probability_of_one()) >> 16;
    if (!decidable(bound)) return false;
    const bool one = take(bound);
    context.update(one);
    return one;
  }

  /// Decodes one equiprobable bit.
  bool code_raw(bool /*bit*/) {
    const std::uint64_t bound = range_ >> 1;
    return decidable(bound) && take(bound);
  }

  /// The last call of `code` or `code_raw` was not answered for want of bytes.
  bool starved() const { return starved_; }

  /// Length of a sequence that ends with the decision decoded last (the encoder's `finish` writes
  /// exactly so many bytes); may lie beyond the bytes that are there.
  std::size_t sequence_length() const {
    return next_ + static_cast<std::size_t>(missing_bits_) / 8 - kUnneededBytes;
  }

 private:
  static constexpr std::uint64_t kSmallestRange = std::uint64_t{1} << 24;
  // Of the register's four bytes, the last two are never written at the end of a sequence.
  static constexpr std::size_t kUnneededBytes = 2;

  bool decidable(std::uint64_t bound) {
    if (missing_bits_ == 0) return true;
    const std::uint64_t mask = (std::uint64_t{1} << missing_bits_) - 1;
    // The mask is added, not OR-ed: subtracting bounds has shifted the interval off its alignment.
    starved_ = missing_bits_ >= 32 || (code_ < bound && code_ + mask >= bound);
    return !starved_;
  }

  bool take(std::uint64_t bound) {
    const bool one = code_ < bound;
    if (one) {
      range_ = bound;
    } else {
      code_ -= bound;
      range_ -= bound;
    }
    while (range_ < kSmallestRange) {
      range_ <<= 8;
      code_ <<= 8;
      if (next_ < bytes_.size()) {
        code_ += bytes_[next_++];
      } else {
        missing_bits_ += 8;
      }
    }
    return one;
  }

  std::span<const std::uint8_t> bytes_;
  std::size_t next_ = 0;
  std::uint64_t range_ = 0xffffffffu;
  std::uint64_t code_ = 0;
  int missing_bits_ = 32;
  bool starved_ = false;
};

}  // namespace zerotree::bitstream
