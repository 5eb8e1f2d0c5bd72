// Binary range encoder: the other end of bitstream/range_decoder.h.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "bitstream/adaptive_bit.h"

namespace zerotree::encode {

/// Codes decisions into bytes. The interval is [low, low + range) with 32 bits before the point
/// that moves; a carry out of `low` runs into bytes that are held back until it is settled.
class RangeEncoder {
 public:
  /// What a pass works with; a decoder's is a copy.
  using Local = RangeEncoder&;

  /// Codes `bit` with the context's probability, lets the context learn it, and returns it.
  bool code(bool bit, bitstream::AdaptiveBit& context) {
    narrow(bit, (range_ * context.probability_of_one()) >> 16);
    context.update(bit);
    return bit;
  }

  /// The same; a decoder's differs in speed.
  bool code_even(bool bit, bitstream::AdaptiveBit& context) { return code(bit, context); }

  /// Codes one equiprobable bit and returns it.
  bool code_raw(bool bit) {
    narrow(bit, range_ >> 1);
    return bit;
  }

  /// Never: what is coded is known. The decoder's counterpart stops a walk.
  static constexpr bool starved() { return false; }

  /// A prefix of this many bytes of the finished sequence decodes everything coded so far. The
  /// finished sequence may be shorter.
  std::size_t sufficient_bytes() const { return shifted_ + 4; }

  /// Ends the sequence and returns its bytes: two bytes after the last shift name a code whose
  /// every continuation lies within the interval, because the interval is longer than 2^24 - 1.
  std::vector<std::uint8_t> finish() {
    constexpr std::uint64_t kTail = (1u << 16) - 1;
    low_ = (low_ + kTail) & ~kTail;
    shift_low();
    shift_low();
    // Settles the bytes held back; the register is empty now, so what follows is not needed.
    release(static_cast<std::uint8_t>(low_ >> 32));
    return std::move(bytes_);
  }

 private:
  static constexpr std::uint64_t kSmallestRange = std::uint64_t{1} << 24;

  void narrow(bool bit, std::uint64_t bound) {
    if (bit) {
      range_ = bound;
    } else {
      low_ += bound;
      range_ -= bound;
    }
    while (range_ < kSmallestRange) {
      range_ <<= 8;
      shift_low();
    }
  }

  // Moves the top byte of the 32-bit `low` out. A byte 0xff may still turn into 0x00 by a carry
  // from below, and the byte before it with it, so those are counted, not written.
  void shift_low() {
    const bool settled = (low_ & 0xffffffffu) < 0xff000000u || (low_ >> 32) != 0;
    if (settled) {
      release(static_cast<std::uint8_t>(low_ >> 32));
      held_ = static_cast<std::uint8_t>(low_ >> 24);
      holds_byte_ = true;
    } else {
      ++held_ones_;
    }
    ++shifted_;
    low_ = (low_ & 0x00ffffffu) << 8;
  }

  void release(std::uint8_t carry) {
    if (holds_byte_) bytes_.push_back(static_cast<std::uint8_t>(held_ + carry));
    bytes_.insert(bytes_.end(), held_ones_, static_cast<std::uint8_t>(0xff + carry));
    held_ones_ = 0;
  }

  std::vector<std::uint8_t> bytes_;
  std::uint64_t low_ = 0;
  std::uint64_t range_ = 0xffffffffu;
  std::size_t shifted_ = 0;
  std::size_t held_ones_ = 0;
  std::uint8_t held_ = 0;
  bool holds_byte_ = false;
};

}  // namespace zerotree::encode
