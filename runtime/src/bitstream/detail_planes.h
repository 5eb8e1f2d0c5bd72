// The passes of one bit plane over all details, for encoder and decoder alike.
//
// Each plane runs from the decisions that buy most error per bit to those that buy least: cells
// with significant neighbours, refinement, then a descent of the edge quadtrees that skips what
// holds nothing (paper, section 3.4). A pass can stop before any decision and go on there later:
// the position is explicit, because a decoder may be out of bytes anywhere.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <utility>

#include "bitstream/detail_contexts.h"
#include "bitstream/detail_state.h"
#include "bitstream/stream_header.h"

namespace zerotree::bitstream {

/// Activity at which a cell is coded in the first and in the second of the likely passes.
inline constexpr std::array<int, 2> kLikelyActivity = {21, 4};

/// What the decoder puts in the place of the coefficients that the encoder knows.
struct UnknownDetails {
  bool significant(int, std::size_t, int) const { return false; }
  bool negative(int, std::size_t) const { return false; }
  bool bit(int, std::size_t, int) const { return false; }
  bool tree_significant(int, std::size_t) const { return false; }
  void begin_cleanup(const DetailState&, int) {}
};

/// Walks the passes. BitCoder is RangeDecoder or the encoder's counterpart: `code(bit, context)`
/// returns the bit coded, or `starved()` is true after it and the walk stops before that decision.
/// Details is UnknownDetails or the encoder's: `significant` tells whether a magnitude reaches
/// 2^plane, `bit` its bit of that plane, `tree_significant` whether a cell or one below it that is
/// open becomes significant in the cleanup that began last. The state has at least one level.
template <class BitCoder, class Details>
class DetailPlanes {
 public:
  DetailPlanes(DetailState& state, Details details) : state_(state), details_(std::move(details)) {}

  /// The four passes of `plane`, in this order; each is called until it returns true. False means
  /// that the coder is starved.
  bool likely_pass(BitCoder& coder, int plane, int which) {
    return sweep([&](int level, int c, std::size_t begin, std::size_t size) {
      return likely_sweep(coder, plane, kLikelyActivity[which], level, c, begin, size);
    });
  }
  bool refinement_pass(BitCoder& coder, int plane) {
    return sweep([&](int, int c, std::size_t begin, std::size_t size) {
      return refinement_sweep(coder, plane, c, begin, size);
    });
  }
  bool cleanup_pass(BitCoder& coder, int plane) {
    if (stage_ == Stage::start) {
      state_.begin_cleanup();
      details_.begin_cleanup(state_, plane);
      channel_ = 0;
      enter_roots();
    }
    while (channel_ < kChannelCount) {
      if (!clean_up_trees(coder, plane)) return false;
      ++channel_;
      enter_roots();
    }
    channel_ = 0;
    stage_ = Stage::start;
    return true;
  }

 private:
  enum class Stage : std::uint8_t { start, tree, root, sign, below, leave };

  // Calls `part` for every level and channel, coarse levels first: their significances tell about
  // the finer ones.
  template <class Part>
  bool sweep(Part part) {
    for (; level_ < state_.levels(); ++level_, channel_ = 0) {
      for (; channel_ < kChannelCount; ++channel_, index_ = 0) {
        if (!part(level_, channel_, state_.level_begin(level_), state_.level_size(level_))) {
          return false;
        }
      }
    }
    level_ = 0;
    return true;
  }

  bool likely_sweep(BitCoder& coder, int plane, int activity, int level, int c, std::size_t begin,
                    std::size_t size) {
    ChannelState& channel = state_.channel(c);
    const std::uint8_t* around = channel.around.data() + begin;
    const std::uint8_t* above = channel.above.data() + begin;
    std::uint8_t* flags = channel.flags.data() + begin;
    auto& contexts = contexts_.significance[kind(c)][level_class(level)];
    for (; index_ < size; ++index_) {
      if (stage_ != Stage::sign) {
        if (index_ % 8 == 0 && skip_quiet(around, above, size)) continue;
        const int a = around[index_], b = above[index_];
        if (flags[index_] != 0 || a + b < activity) continue;
        const bool truth = details_.significant(c, begin + index_, plane);
        const bool significant = coder.code(truth, contexts[kAroundClass[a]][kAboveClass[b]]);
        if (coder.starved()) return false;
        flags[index_] = kVisited;
        if (!significant) continue;
      }
      if (!code_sign(coder, plane, level, c, index_)) return false;
    }
    return true;
  }

  // Eight cells that nothing significant touches, which is nearly everywhere in early planes.
  bool skip_quiet(const std::uint8_t* around, const std::uint8_t* above, std::size_t size) {
    if (index_ + 8 > size) return false;
    std::uint64_t a, b;
    std::memcpy(&a, around + index_, 8);
    std::memcpy(&b, above + index_, 8);
    if ((a | b) != 0) return false;
    index_ += 7;
    return true;
  }

  bool refinement_sweep(BitCoder& coder, int plane, int c, std::size_t begin, std::size_t size) {
    const ChannelState& channel = state_.channel(c);
    const std::uint8_t* flags = channel.flags.data() + begin;
    for (; index_ < size; ++index_) {
      if ((flags[index_] & (kSignificant | kVisited)) != kSignificant) continue;
      const std::size_t cell = begin + index_;
      // In units of 2^plane: 6 before the first refinement, 10 or 14 before the second.
      const int known = std::abs(state_.value(c, cell)) >> plane;
      const int which = known < 8 ? 0 : known < 16 ? 1 : 2;
      const int activity = std::min(255, channel.around[cell] + channel.above[cell]);
      const bool bit = coder.code(details_.bit(c, cell, plane),
                                  contexts_.refinement[which][kRefinementClass[activity]]);
      if (coder.starved()) return false;
      state_.refine(c, cell, plane, bit);
    }
    return true;
  }

  bool code_sign(BitCoder& coder, int plane, int level, int c, std::size_t index) {
    stage_ = Stage::sign;
    const std::size_t cell = state_.level_begin(level) + index;
    const bool negative = coder.code(details_.negative(c, cell), sign_context(level, c, index));
    if (coder.starved()) return false;
    stage_ = Stage::start;
    state_.set_significant(c, level, index, plane, negative);
    return true;
  }

  AdaptiveBit& sign_context(int level, int c, std::size_t index) {
    const std::size_t begin = state_.level_begin(level);
    const int parent =
        level == 0 ? 0 : sign_class(state_.value(c, state_.level_begin(level - 1) + index / 4));
    if (c == kNormal) {
      const int lean = lean_class(state_.channel(c).lean[begin + index]);
      return contexts_.normal_sign[lean][parent][level + 1 == state_.levels() ? 1 : 0];
    }
    const int sibling = level == 0 ? 0 : sign_class(state_.value(c, begin + (index ^ 3)));
    return contexts_.tangent_sign[c - kTangent1][parent][sibling];
  }

  // --- cleanup: the position is the node (level_, index_) and what is next to be done there ---

  void enter_roots() {
    level_ = 0;
    index_ = 0;
    stage_ = Stage::tree;
    found_[0] = false;
  }

  bool clean_up_trees(BitCoder& coder, int plane) {
    while (index_ < state_.level_size(level_)) {
      if (stage_ == Stage::tree && !code_tree(coder)) return false;
      if (stage_ == Stage::root && !code_root(coder, plane)) return false;
      if (stage_ == Stage::sign) {
        if (!code_sign(coder, plane, level_, channel_, index_)) return false;
        stage_ = Stage::below;
      }
      if (stage_ == Stage::below && !code_below(coder)) return false;
      if (stage_ == Stage::leave) next_node();
    }
    level_ = 0;
    index_ = 0;
    return true;
  }

  bool code_tree(BitCoder& coder) {
    const std::size_t cell = state_.level_begin(level_) + index_;
    const ChannelState& channel = state_.channel(channel_);
    if (channel.open[cell] == 0) {
      stage_ = Stage::leave;
      return true;
    }
    if (!implied(cell)) {
      const int activity =
          channel.flags[cell] == 0 ? quiet_class(cell) : static_cast<int>(kQuietCuts.size()) + 1;
      AdaptiveBit& context =
          contexts_.tree[kind(channel_)][height()][activity][found_[level_] ? 1 : 0];
      const bool holds = coder.code(details_.tree_significant(channel_, cell), context);
      if (coder.starved()) return false;
      if (!holds) {
        stage_ = Stage::leave;
        return true;
      }
    }
    found_[level_] = true;
    stage_ = Stage::root;
    return true;
  }

  // The parent's trees hold something, no earlier one did, and no later one is open.
  bool implied(std::size_t cell) const {
    if (level_ == 0 || found_[level_]) return false;
    const std::uint8_t* open = state_.channel(channel_).open.data();
    for (std::size_t later = 1; later < 4 - (index_ & 3); ++later) {
      if (open[cell + later] != 0) return false;
    }
    return true;
  }

  bool code_root(BitCoder& coder, int plane) {
    const std::size_t cell = state_.level_begin(level_) + index_;
    stage_ = Stage::below;
    below_implied_ = true;
    if (state_.channel(channel_).flags[cell] != 0) return true;
    if (children_open()) {
      stage_ = Stage::root;
      const bool truth = details_.significant(channel_, cell, plane);
      AdaptiveBit& context = contexts_.root[kind(channel_)][height()][quiet_class(cell)];
      const bool significant = coder.code(truth, context);
      if (coder.starved()) return false;
      if (!significant) {
        stage_ = Stage::below;
        return true;
      }
    }
    below_implied_ = false;
    stage_ = Stage::sign;
    return true;
  }

  bool code_below(BitCoder& coder) {
    if (!children_open()) {
      stage_ = Stage::leave;
      return true;
    }
    if (!below_implied_) {
      bool truth = false;
      for (std::size_t k = 0; k < 4; ++k) {
        truth = truth || details_.tree_significant(channel_, first_child() + k);
      }
      const bool holds = coder.code(truth, contexts_.below[kind(channel_)][height()]);
      if (coder.starved()) return false;
      if (!holds) {
        stage_ = Stage::leave;
        return true;
      }
    }
    ++level_;
    index_ *= 4;
    found_[level_] = false;
    stage_ = Stage::tree;
    return true;
  }

  void next_node() {
    while (level_ > 0 && index_ % 4 == 3) {
      --level_;
      index_ /= 4;
    }
    ++index_;
    if (level_ == 0) found_[0] = false;
    stage_ = Stage::tree;
  }

  std::size_t first_child() const { return state_.level_begin(level_ + 1) + 4 * index_; }

  bool children_open() const {
    if (level_ + 1 == state_.levels()) return false;
    const std::uint8_t* open = state_.channel(channel_).open.data() + first_child();
    return (open[0] | open[1] | open[2] | open[3]) != 0;
  }

  int height() const {
    return std::min(state_.levels() - 1 - level_, DetailContexts::kHeights - 1);
  }
  int quiet_class(std::size_t cell) const {
    const ChannelState& channel = state_.channel(channel_);
    return kQuietClass[std::min(255, channel.around[cell] + channel.above[cell])];
  }
  static int kind(int c) { return c == kNormal ? 0 : 1; }
  int level_class(int level) const { return level + 1 == state_.levels() ? 2 : level == 0 ? 0 : 1; }

  DetailState& state_;
  Details details_;
  DetailContexts contexts_;

  int level_ = 0;
  int channel_ = 0;
  std::size_t index_ = 0;
  Stage stage_ = Stage::start;
  bool below_implied_ = false;
  std::array<bool, kMostLevels + 1> found_{};
};

}  // namespace zerotree::bitstream
