// The passes of one bit plane over all details, for encoder and decoder alike.
//
// Each plane runs from the decisions that buy most error per bit to those that buy least: cells
// with significant neighbours, refinement, then the cleanup (tree_cleanup.h). A pass can stop
// before any decision and go on there later: the position is explicit, because a decoder may be out
// of bytes anywhere.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <utility>

#include "bitstream/detail_coding.h"
#include "bitstream/tree_cleanup.h"

namespace zerotree::bitstream {

/// Activity at which a cell is coded in the first and in the second of the likely passes.
inline constexpr std::array<std::uint8_t, 2> kLikelyActivity = {21, 4};

/// Walks the passes. BitCoder is RangeDecoder or the encoder's counterpart: `code(bit, context)`
/// returns the bit coded, or `starved()` is true after it and the walk stops before that decision.
/// Its `Local` is the coder as a pass keeps it while it runs. The state has at least one level.
template <class BitCoder, class Details>
class DetailPlanes {
 public:
  DetailPlanes(DetailState& state, Details details)
      : coding_(state, std::move(details)), state_(state), cleanup_(coding_) {}
  DetailPlanes(const DetailPlanes&) = delete;
  DetailPlanes& operator=(const DetailPlanes&) = delete;

  /// The four passes of `plane`, in this order; each is called until it returns true. False means
  /// that the coder is starved.
  bool likely_pass(BitCoder& coder, int plane, int which) {
    return sweep([&](int level, int c) {
      return level >= state_.active_levels(c) ||
             likely_sweep(coder, plane, kLikelyActivity[which], level, c);
    });
  }
  bool refinement_pass(BitCoder& coder, int plane) {
    return sweep([&](int level, int c) {
      if (!state_.has_details(c, level)) return true;
      LevelValues& values = state_.values(c, level);
      return values.is_wide() ? refinement_sweep(coder, values.wide(), plane, level, c)
                              : refinement_sweep(coder, values.narrow(), plane, level, c);
    });
  }
  bool cleanup_pass(BitCoder& coder, int plane) { return cleanup_.pass(coder, plane); }

 private:
  // Calls `part` for every level and channel, coarse levels first: their significances tell about
  // the finer ones.
  template <class Part>
  bool sweep(Part part) {
    for (; level_ < state_.levels(); ++level_, channel_ = 0) {
      for (; channel_ < kChannelCount; ++channel_, index_ = 0) {
        if (!part(level_, channel_)) return false;
      }
    }
    level_ = 0;
    return true;
  }

  // Stops at cell `index`: the next call begins with it.
  bool stop_at(std::size_t index) {
    index_ = index;
    return false;
  }

  // Calls `part` for the beginning of every touched block, from the one of index_ on.
  template <class Part>
  bool for_blocks(const ChannelCells& cells, int level, Part part) const {
    const std::size_t blocks = state_.block_count(level);
    for (std::size_t block = index_ / kBlockCells; block < blocks; ++block) {
      if (cells.touched[block] != 0 && !part(block * kBlockCells)) return false;
    }
    return true;
  }

  // The cells of the block at `begin` that a sweep has not come to yet.
  BlockMask still_ahead(std::size_t begin) const {
    return begin < index_ ? ~BlockMask{0} << (index_ % kBlockCells) : ~BlockMask{0};
  }

  bool likely_sweep(BitCoder& home, int plane, std::uint8_t activity, int level, int c) {
    typename BitCoder::Local coder(home);
    if (sign_due_) {
      if (!coding_.code_sign(coder, plane, level, c, index_)) return false;
      sign_due_ = false;
    }
    const ChannelCells cells = state_.cells(c, level);
    const std::size_t first_cell = state_.level_begin(level);
    auto& contexts = coding_.contexts.significance[coding_.kind(c)][coding_.level_class(level)];
    return for_blocks(cells, level, [&](std::size_t begin) {
      const auto likely = [&] {
        return likely_cells(cells.flags + begin, cells.around + begin, cells.above + begin,
                            activity);
      };
      for (BlockMask left = likely() & still_ahead(begin); left != 0;) {
        const std::size_t i = begin + static_cast<std::size_t>(std::countr_zero(left));
        left &= left - 1;
        const bool truth = coding_.details.significant(c, first_cell + i, plane);
        const bool significant =
            coder.code(truth, contexts[kAroundClass[cells.around[i]]][kAboveClass[cells.above[i]]]);
        if (coder.starved()) return stop_at(i);
        cells.flags[i] = kVisited;
        if (!significant) continue;
        sign_due_ = true;
        if (!coding_.code_sign(coder, plane, level, c, i)) return stop_at(i);
        sign_due_ = false;
        // It may have made cells ahead likely; those behind it have had their turn.
        left = likely() & ~BlockMask{1} << (i % kBlockCells);
      }
      return true;
    });
  }

  template <class Value>
  bool refinement_sweep(BitCoder& home, Value* values, int plane, int level, int c) {
    typename BitCoder::Local coder(home);
    const ChannelCells cells = state_.cells(c, level);
    const std::size_t first_cell = state_.level_begin(level);
    auto& contexts = coding_.contexts.refinement;
    const int half = 1 << plane;
    bool changed = false;
    const bool done = for_blocks(cells, level, [&](std::size_t begin) {
      BlockMask left = refinable_cells(cells.flags + begin) & still_ahead(begin);
      for (; left != 0; left &= left - 1) {
        const std::size_t i = begin + static_cast<std::size_t>(std::countr_zero(left));
        const int value = values[i];
        // In units of 2^plane: 6 before the first refinement, 10 or 14 before the second.
        const int known = std::abs(value) >> plane;
        const int which = int{known >= 8} + int{known >= 16};
        const int activity = std::min(255, cells.around[i] + cells.above[i]);
        const bool bit = coder.code_even(coding_.details.bit(c, first_cell + i, plane),
                                         contexts[which][kRefinementClass[activity]]);
        if (coder.starved()) return stop_at(i);
        const int outwards = bit ? half : -half;
        values[i] = static_cast<Value>(value + (value < 0 ? -outwards : outwards));
        changed = true;
      }
      return true;
    });
    if (changed) state_.note_change(level);
    return done;
  }

  DetailCoding<Details> coding_;
  DetailState& state_;
  TreeCleanup<BitCoder, Details> cleanup_;

  int level_ = 0;
  int channel_ = 0;
  std::size_t index_ = 0;
  bool sign_due_ = false;  // the cell at index_ is significant
};

}  // namespace zerotree::bitstream
