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
      const std::vector<std::uint8_t>& flags = state.channel(c).flags;
      trees_[c].resize(flags.size());
      for (std::size_t i = 0; i < flags.size(); ++i) {
        trees_[c][i] = flags[i] == 0 && significant(c, i, plane) ? 1 : 0;
      }
      for (int level = state.levels() - 1; level > 0; --level) {
        const std::size_t parents = state.level_begin(level - 1);
        const std::size_t children = state.level_begin(level);
        for (std::size_t i = 0; i < state.level_size(level); ++i) {
          trees_[c][parents + i / 4] |= trees_[c][children + i];
        }
      }
    }
  }

 private:
  std::uint32_t magnitude(int c, std::size_t cell) const {
    return static_cast<std::uint32_t>(std::abs(coefficients_->channels[c][cell])) >> 1;
  }

  const bitstream::CoefficientSet* coefficients_;
  std::array<std::vector<std::uint8_t>, bitstream::kChannelCount> trees_;
};

}  // namespace zerotree::encode
