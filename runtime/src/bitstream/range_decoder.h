// Binary range decoder that knows what it does not know.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include "bitstream/adaptive_bit.h"

namespace zerotree::bitstream {

/// Decodes the decisions of a byte sequence of which only a prefix may be there.
///
/// The upper half of a 64-bit window is the code register; below it stand bytes read ahead. Of a
/// register that is not complete the missing bits count as zeros, and as ones in a mask above it:
/// the true code lies in [code, code + mask]. A decision is taken only if it is the same over that
/// whole interval; otherwise the decoder is `starved`: the call returned false, changed nothing,
/// and must be repeated after `add_bytes` brought more. So decoding in pieces takes exactly the
/// decisions of decoding at once. Any bytes are safe.
class RangeDecoder {
 public:
  class Local;

  RangeDecoder() = default;
  explicit RangeDecoder(std::span<const std::uint8_t> bytes) { add_bytes(bytes); }

  /// The next bytes of the sequence, once all earlier ones are absorbed: at the beginning or when
  /// starved. They are neither copied nor owned and must stay until the decoder is starved.
  void add_bytes(std::span<const std::uint8_t> bytes) {
    next_ = bytes.data();
    end_ = next_ + bytes.size();
    starved_ = false;
    while (absorbed_ < 4 && next_ != end_) absorb_first();
    if (known_bits_ < 32) refill();
  }

  /// Decodes one bit; the argument is there for the encoder's sake.
  bool code(bool /*bit*/, AdaptiveBit& context) {
    const std::uint64_t bound = (range_ * context.probability_of_one()) >> 16;
    if (is_open(bound)) [[unlikely]]
      return false;
    // A jump: most bits are foreseen, so the next decision can begin before this one is known.
    const bool one = (window_ >> 32) < bound;
    if (one) {
      take_one(bound);
      context.update(true);
    } else {
      take_zero(bound);
      context.update(false);
    }
    return one;
  }

  /// The same, faster for a bit that is hard to foresee if the caller does not jump on it either.
  bool code_even(bool /*bit*/, AdaptiveBit& context) {
    const std::uint64_t bound = (range_ * context.probability_of_one()) >> 16;
    if (is_open(bound)) [[unlikely]]
      return false;
    const bool one = take(bound);
    context.update(one);
    return one;
  }

  /// Decodes one equiprobable bit.
  bool code_raw(bool /*bit*/) {
    const std::uint64_t bound = range_ >> 1;
    if (is_open(bound)) [[unlikely]]
      return false;
    return take(bound);
  }

  /// The last call of `code` or `code_raw` was not answered for want of bytes.
  bool starved() const { return starved_; }

  /// Length of a sequence that ends with the decision decoded last (the encoder's `finish` writes
  /// exactly so many bytes); may lie beyond the bytes that are there.
  std::size_t sequence_length() const {
    const std::uint64_t shifted_out = absorbed_ * 8 - static_cast<std::uint64_t>(known_bits_);
    return static_cast<std::size_t>(shifted_out / 8) + 4 - kUnneededBytes;
  }

 private:
  static constexpr std::uint64_t kSmallestRange = std::uint64_t{1} << 24;
  // Of the register's four bytes, the last two are never written at the end of a sequence.
  static constexpr std::size_t kUnneededBytes = 2;

  // Whether bits that are missing from the register decide: then the decoder is starved.
  bool is_open(std::uint64_t bound) {
    if (known_bits_ >= 32) [[likely]]
      return false;
    starved_ = differs(window_, known_bits_, bound);
    return starved_;
  }

  static bool differs(std::uint64_t window, int known_bits, std::uint64_t bound) {
    if (known_bits <= 0) return true;
    const std::uint64_t code = window >> 32;
    const std::uint64_t mask = (std::uint64_t{1} << (32 - known_bits)) - 1;
    // The mask is added, not OR-ed: subtracting bounds has shifted the interval off its alignment.
    return code < bound && code + mask >= bound;
  }

  void take_one(std::uint64_t bound) {
    range_ = bound;
    if (range_ < kSmallestRange) normalise();
  }
  void take_zero(std::uint64_t bound) {
    window_ -= bound << 32;
    range_ -= bound;
    if (range_ < kSmallestRange) [[unlikely]]
      normalise();
  }

  // All ones or all zeros in a mask, because compilers make jumps of a choice.
  bool take(std::uint64_t bound) {
    const bool one = (window_ >> 32) < bound;
    const std::uint64_t mask = std::uint64_t{0} - std::uint64_t{one};
    window_ -= (bound << 32) & ~mask;
    range_ = range_ - bound + ((2 * bound - range_) & mask);
    if (range_ < kSmallestRange) [[unlikely]]
      normalise();
    return one;
  }

  // The range has 9 bits or more; whole bytes bring it back to 25 or more.
  void normalise() {
    const int shift = std::countl_zero(static_cast<std::uint32_t>(range_) | 1u) & 24;
    range_ <<= shift;
    window_ <<= shift;
    known_bits_ -= shift;
    if (known_bits_ < 32) refill();
  }

  void refill() {
    if (end_ - next_ >= 4) {
      const std::uint32_t word = (std::uint32_t{next_[0]} << 24) | (std::uint32_t{next_[1]} << 16) |
                                 (std::uint32_t{next_[2]} << 8) | std::uint32_t{next_[3]};
      window_ += static_cast<std::uint64_t>(word | overrun_) << (32 - known_bits_);
      next_ += 4;
      absorbed_ += 4;
      known_bits_ += 32;
      return;
    }
    while (next_ != end_) absorb(static_cast<std::uint8_t>(*next_++ | overrun_));
  }

  void absorb(std::uint8_t byte) {
    // Fewer than no bits: the decision taken last has settled that this byte's are zeros.
    if (known_bits_ >= 0) window_ += static_cast<std::uint64_t>(byte) << (56 - known_bits_);
    known_bits_ += 8;
    ++absorbed_;
  }

  // A register of ones only is not below the range: no encoder writes it, and by the rules every
  // decision is then zero. The greatest code below the range, followed by ones, says the same.
  void absorb_first() {
    const std::uint8_t byte = *next_++;
    begins_with_ones_ = begins_with_ones_ && byte == 0xff;
    const bool overrun = absorbed_ == 3 && begins_with_ones_;
    if (overrun) overrun_ = 0xffffffffu;
    absorb(overrun ? 0xfe : byte);
  }

  std::uint64_t window_ = 0;
  std::uint64_t range_ = 0xffffffffu;
  int known_bits_ = 0;  // of the window, from the top
  bool starved_ = false;
  bool begins_with_ones_ = true;
  std::uint32_t overrun_ = 0;
  const std::uint8_t* next_ = nullptr;
  const std::uint8_t* end_ = nullptr;
  std::uint64_t absorbed_ = 0;  // bytes of the sequence that have entered the window
};

/// A decoder on loan to one function, whose compiler can keep it in registers: what the function
/// stores as bytes cannot alias it. It goes back where it came from at the end.
class RangeDecoder::Local : public RangeDecoder {
 public:
  explicit Local(RangeDecoder& home) : RangeDecoder(home), home_(home) {}
  ~Local() { home_ = *this; }
  Local(const Local&) = delete;
  Local& operator=(const Local&) = delete;

 private:
  RangeDecoder& home_;
};

}  // namespace zerotree::bitstream
