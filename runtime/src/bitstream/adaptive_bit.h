// The probability of one binary decision, learned while coding.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

namespace zerotree::bitstream {

/// Probability that the next bit is 1: the mean of two exponential averages, one that follows
/// changes (window 2^5) and one that is precise (window 2^8). While few bits have been seen the
/// windows are as short as the history, so that a context learns from its first bits on.
/// Integers only: encoder and decoder run through the same states on every machine.
class alignas(8) AdaptiveBit {
 public:
  /// In units of 2^-16; always within 1 .. 65535.
  std::uint32_t probability_of_one() const {
    return (std::uint32_t{fast_} + std::uint32_t{slow_}) >> 1;
  }

  /// Without branches: what comes next is a jump on the bit itself, and one is enough.
  void update(bool bit) {
    const std::uint32_t mask = (0u - std::uint32_t{bit}) & 0xffffu;
    const std::uint8_t seen = seen_;
    const Windows windows = kWindows[seen];
    fast_ = moved(fast_, mask, windows.fast);
    slow_ = moved(slow_, mask, windows.slow);
    seen_ = static_cast<std::uint8_t>(seen + (seen < kSeenEnough ? 1 : 0));
  }

 private:
  static constexpr int kFastWindow = 5;
  static constexpr int kSlowWindow = 8;
  static constexpr std::uint8_t kSeenEnough = (1u << kSlowWindow) - 2;

  struct Windows {
    std::uint8_t fast, slow;
  };

  static constexpr std::array<Windows, kSeenEnough + 1> make_windows() {
    std::array<Windows, kSeenEnough + 1> table{};
    for (unsigned seen = 0; seen < table.size(); ++seen) {
      const int window = std::bit_width(seen + 2u) - 1;
      table[seen] = {static_cast<std::uint8_t>(std::min(window, kFastWindow)),
                     static_cast<std::uint8_t>(std::min(window, kSlowWindow))};
    }
    return table;
  }
  static const std::array<Windows, kSeenEnough + 1> kWindows;

  // Towards 0, or with all bits of the mask set towards 65535. Truncation keeps the value off 0
  // and 65536: a decision never becomes certain.
  static std::uint16_t moved(std::uint32_t probability, std::uint32_t mask, int window) {
    std::uint32_t distance = probability ^ mask;
    distance -= distance >> window;
    return static_cast<std::uint16_t>(distance ^ mask);
  }

  std::uint16_t fast_ = 1u << 15;
  std::uint16_t slow_ = 1u << 15;
  std::uint8_t seen_ = 0;
};

inline constexpr std::array<AdaptiveBit::Windows, AdaptiveBit::kSeenEnough + 1>
    AdaptiveBit::kWindows = AdaptiveBit::make_windows();

}  // namespace zerotree::bitstream
