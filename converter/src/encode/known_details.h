// What the encoder knows and the decoder has to be told.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "bitstream/coefficient_layout.h"
#include "bitstream/detail_state.h"

namespace zerotree::encode {

/// The encoder's place of bitstream::UnknownDetails. The coefficients are the caller's.
class KnownDetails {
 public:
  explicit KnownDetails(const bitstream::CoefficientSet& coefficients)
      : coefficients_(&coefficients) {}

  bool significant(int c, std::size_t cell, int plane) const {
    return (magnitude(c, cell) >> plane) != 0;
  }
  bool negative(int c, std::size_t cell) const { return coefficients_->channels[c][cell] < 0; }
  bool bit(int c, std::size_t cell, int plane) const {
    return ((magnitude(c, cell) >> plane) & 1) != 0;
  }
  bool tree_significant(int c, std::size_t cell) const { return trees_[c][cell] != 0; }

  /// Finds the trees in which an open cell reaches `plane`, from the finest level up.
  void begin_cleanup(const bitstream::DetailState& state, int plane) {
    for (int c = 0; c < bitstream::kChannelCount; ++c) {
      trees_[c].assign(state.level_begin(state.levels()), 0);
      for (int level = state.levels() - 1; level >= 0; --level) {
        find_trees(state, c, level, plane);
      }
    }
  }

 private:
  // Marks the trees of a level whose children are marked already, and passes the marks on.
  void find_trees(const bitstream::DetailState& state, int c, int level, int plane) {
    const std::size_t begin = state.level_begin(level);
    std::uint8_t* trees = trees_[c].data() + begin;
    std::uint8_t* parents = level == 0 ? nullptr : trees_[c].data() + state.level_begin(level - 1);
    // Where nothing is active no cell is coded yet; an absent one holds zero.
    const std::uint8_t* flags =
        level < state.active_levels(c) ? state.cells(c, level).flags : nullptr;
    for (std::size_t i = 0; i < state.level_size(level); ++i) {
      const bool is_coded =
          flags != nullptr && (flags[i] & (bitstream::kSignificant | bitstream::kVisited)) != 0;
      if (!is_coded && significant(c, begin + i, plane)) trees[i] = 1;
      if (parents != nullptr) parents[i / 4] |= trees[i];
    }
  }

  std::uint32_t magnitude(int c, std::size_t cell) const {
    return static_cast<std::uint32_t>(std::abs(coefficients_->channels[c][cell])) >> 1;
  }

  const bitstream::CoefficientSet* coefficients_;
  std::array<std::vector<std::uint8_t>, bitstream::kChannelCount> trees_;
};

}  // namespace zerotree::encode
