// Which adaptive bit a decision about a detail uses.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "bitstream/adaptive_bit.h"
#include "bitstream/coefficient_layout.h"

namespace zerotree::bitstream {

/// Table of the class of every byte: how many of the ascending `cuts` it reaches.
template <std::size_t N>
constexpr std::array<std::uint8_t, 256> byte_classes(const std::array<int, N>& cuts) {
  std::array<std::uint8_t, 256> table{};
  for (int value = 0; value < 256; ++value) {
    std::uint8_t reached = 0;
    while (reached < N && value >= cuts[reached]) ++reached;
    table[value] = reached;
  }
  return table;
}

inline constexpr std::array kAroundCuts = {1, 4, 8, 12, 16, 23, 32, 48, 64, 96, 160};
inline constexpr std::array kAboveCuts = {1, 4, 8, 16, 32, 64};
inline constexpr std::array kRefinementCuts = {4, 10, 18, 28, 40, 56, 80, 112, 160};
inline constexpr std::array kQuietCuts = {1, 4, 12};
inline constexpr std::array kLeanCuts = {1, 8, 24};

inline constexpr auto kAroundClass = byte_classes(kAroundCuts);
inline constexpr auto kAboveClass = byte_classes(kAboveCuts);
inline constexpr auto kRefinementClass = byte_classes(kRefinementCuts);
inline constexpr auto kQuietClass = byte_classes(kQuietCuts);
inline constexpr auto kLeanClass = byte_classes(kLeanCuts);

/// 0 none, 1 positive, 2 negative. Signs are hard to foresee, so there is no jump on them.
constexpr int sign_class(std::int32_t value) {
  return int{value > 0} + 2 * int{value < 0};
}

/// 0..6: none, then three strengths of leaning to positive and three to negative.
constexpr int lean_class(int lean) {
  const int strength = kLeanClass[static_cast<std::size_t>(lean < 0 ? -lean : lean)];
  return strength + int{lean < 0} * static_cast<int>(kLeanCuts.size());
}

/// All contexts of the details. One value per decision's kind and situation; levels and channels
/// share contexts where their statistics are alike, so that few bits are spent on learning.
struct DetailContexts {
  static constexpr int kKinds = 2;    // normal, tangent
  static constexpr int kHeights = 8;  // levels below a tree node, the last class for all above

  template <class T, std::size_t... Sizes>
  struct Table;
  template <class T, std::size_t Size>
  struct Table<T, Size> {
    using type = std::array<T, Size>;
  };
  template <class T, std::size_t Size, std::size_t... Rest>
  struct Table<T, Size, Rest...> {
    using type = std::array<typename Table<T, Rest...>::type, Size>;
  };
  template <std::size_t... Sizes>
  using Bits = typename Table<AdaptiveBit, Sizes...>::type;

  /// Significance in the likely passes: kind; first, middle, last level; around; above.
  Bits<kKinds, 3, kAroundCuts.size() + 1, kAboveCuts.size() + 1> significance;
  /// Sign of a normal detail: lean; parent's sign; last level or not.
  Bits<2 * kLeanCuts.size() + 1, 3, 2> normal_sign;
  /// Sign of a tangential detail: which; parent's sign; sign of the sibling with the other bits.
  Bits<2, 3, 3> tangent_sign;
  /// Refinement: first bit, second bit, later ones; activity.
  Bits<3, kRefinementCuts.size() + 1> refinement;
  /// Cleanup, whether a tree holds anything: kind; height; activity of its root, or root coded
  /// already; whether an earlier sibling did.
  Bits<kKinds, kHeights, kQuietCuts.size() + 2, 2> tree;
  /// Cleanup, whether the root of such a tree is significant: kind; height; activity.
  Bits<kKinds, kHeights, kQuietCuts.size() + 1> root;
  /// Cleanup, whether the trees below a significant root hold anything: kind; height.
  Bits<kKinds, kHeights> below;
};

}  // namespace zerotree::bitstream
