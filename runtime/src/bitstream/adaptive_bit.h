// The probability of one binary decision, learned while coding.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

namespace zerotree::bitstream {

/// Probability that the next bit is 1: the mean of two exponential averages, one that follows
/// changes (window 2^5) and one that is precise (window 2^8). While few bits have been seen the
/// windows are as short as the history, so that a context learns from its first bits on.
/// Integers only: encoder and decoder run through the same states on every machine.
class AdaptiveBit {
 public:
  /// In units of 2^-16; always within 1 .. 65535.
  std::uint32_t probability_of_one() const {
    return (std::uint32_t{fast_} + std::uint32_t{slow_}) >> 1;
  }

  void update(bool bit) {
    const int window = std::bit_width(seen_ + 2u) - 1;
    move(fast_, bit, std::min(window, kFastWindow));
    move(slow_, bit, std::min(window, kSlowWindow));
    if (seen_ < kSeenEnough) ++seen_;
  }

 private:
  static constexpr int kFastWindow = 5;
  static constexpr int kSlowWindow = 8;
  static constexpr std::uint8_t kSeenEnough = (1u << kSlowWindow) - 2;

  // Truncation keeps the value off 0 and 65536: a decision never becomes certain.
  static void move(std::uint16_t& probability, bool bit, int window) {
    if (bit) {
      probability = static_cast<std::uint16_t>(probability + ((65535u - probability) >> window));
    } else {
      probability = static_cast<std::uint16_t>(probability - (probability >> window));
    }
  }

  std::uint16_t fast_ = 1u << 15;
  std::uint16_t slow_ = 1u << 15;
  std::uint8_t seen_ = 0;
};

}  // namespace zerotree::bitstream
