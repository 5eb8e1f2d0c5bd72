// The last pass of a bit plane: a descent of the edge quadtrees that skips what holds nothing.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "bitstream/detail_coding.h"

namespace zerotree::bitstream {

/// Finds the significances that the likely passes left out (paper, section 3.4). Goes on where it
/// stopped: at a node of a tree, before the decision that is due there.
template <class BitCoder, class Details>
class TreeCleanup {
 public:
  explicit TreeCleanup(DetailCoding<Details>& coding) : coding_(coding) {}

  /// Called until it returns true; false means that the coder is starved.
  bool pass(BitCoder& coder, int plane) {
    if (!begun_) {
      coding_.state.begin_cleanup();
      coding_.details.begin_cleanup(coding_.state, plane);
      begun_ = true;
    }
    for (; channel_ < kChannelCount; ++channel_, node_ = {}) {
      if (!clean_up_trees(coder, plane)) return false;
    }
    channel_ = 0;
    begun_ = false;
    return true;
  }

 private:
  enum class Stage : std::uint8_t { tree, root, sign, below, leave };

  // Where the pass is. Level by level the trees on the way to the node stand for themselves:
  // `found` tells whether one of their siblings so far, or they, hold something.
  struct Node {
    int level = 0;
    Stage stage = Stage::tree;
    bool below_implied = false;
    std::uint32_t found = 0;  // bit per level
    std::size_t index = 0;
  };

  bool clean_up_trees(BitCoder& home, int plane) {
    typename BitCoder::Local coder(home);
    Node node = node_;
    const std::size_t roots = coding_.state.level_size(0);
    while (node.level > 0 || node.index < roots) {
      const bool answered = step(coder, plane, node);
      if (!answered) {
        node_ = node;
        return false;
      }
    }
    return true;
  }

  template <class Coder>
  bool step(Coder& coder, int plane, Node& node) {
    if (node.stage == Stage::tree && !code_tree(coder, node)) return false;
    if (node.stage == Stage::root && !code_root(coder, plane, node)) return false;
    if (node.stage == Stage::sign) {
      if (!coding_.code_sign(coder, plane, node.level, channel_, node.index)) return false;
      node.stage = Stage::below;
    }
    if (node.stage == Stage::below && !code_below(coder, node)) return false;
    if (node.stage == Stage::leave) go_on(node);
    return true;
  }

  template <class Coder>
  bool code_tree(Coder& coder, Node& node) {
    activate(node.level);
    const std::uint8_t* flags = coding_.state.cells(channel_, node.level).flags;
    node.stage = Stage::leave;
    if ((flags[node.index] & coding_.state.closed_flags(node.level)) != 0) return true;
    if (!is_implied(node)) {
      const int activity =
          flags[node.index] == 0 ? quiet_class(node) : static_cast<int>(kQuietCuts.size()) + 1;
      AdaptiveBit& context =
          coding_.contexts.tree[kind()][height(node)][activity][has_found(node) ? 1 : 0];
      const bool holds =
          coder.code(coding_.details.tree_significant(channel_, cell(node)), context);
      if (coder.starved()) {
        node.stage = Stage::tree;
        return false;
      }
      if (!holds) return true;
    }
    node.found |= std::uint32_t{1} << node.level;
    node.stage = Stage::root;
    return true;
  }

  // The parent's trees hold something, no earlier one did, and no later one is open.
  bool is_implied(const Node& node) const {
    if (node.level == 0 || has_found(node)) return false;
    const std::uint8_t* flags = coding_.state.cells(channel_, node.level).flags;
    const std::uint8_t closed = coding_.state.closed_flags(node.level);
    for (std::size_t later = node.index + 1; (later & 3) != 0; ++later) {
      if ((flags[later] & closed) == 0) return false;
    }
    return true;
  }

  template <class Coder>
  bool code_root(Coder& coder, int plane, Node& node) {
    node.below_implied = true;
    if (coding_.state.cells(channel_, node.level).flags[node.index] != 0) {
      node.stage = Stage::below;
      return true;
    }
    if (children_open(node)) {
      const bool truth = coding_.details.significant(channel_, cell(node), plane);
      AdaptiveBit& context = coding_.contexts.root[kind()][height(node)][quiet_class(node)];
      const bool significant = coder.code(truth, context);
      if (coder.starved()) return false;
      if (!significant) {
        node.stage = Stage::below;
        return true;
      }
    }
    node.below_implied = false;
    node.stage = Stage::sign;
    return true;
  }

  template <class Coder>
  bool code_below(Coder& coder, Node& node) {
    if (!children_open(node)) {
      node.stage = Stage::leave;
      return true;
    }
    if (!node.below_implied) {
      const bool holds =
          coder.code(children_significant(node), coding_.contexts.below[kind()][height(node)]);
      if (coder.starved()) return false;
      if (!holds) {
        node.stage = Stage::leave;
        return true;
      }
    }
    ++node.level;
    node.index *= 4;
    node.found &= ~(std::uint32_t{1} << node.level);
    node.stage = Stage::tree;
    return true;
  }

  static void go_on(Node& node) {
    while (node.level > 0 && node.index % 4 == 3) {
      --node.level;
      node.index /= 4;
    }
    ++node.index;
    if (node.level == 0) node.found = 0;
    node.stage = Stage::tree;
  }

  bool children_open(const Node& node) const {
    const DetailState& state = coding_.state;
    const int below = node.level + 1;
    if (below == state.levels()) return false;
    // The node is not absent, so neither are all its children.
    if (below >= state.active_levels(channel_)) return true;
    std::uint32_t four;
    std::memcpy(&four, state.cells(channel_, below).flags + 4 * node.index, 4);
    const std::uint32_t closed = four & (state.closed_flags(below) * 0x01010101u);
    return ((closed + 0x0f0f0f0fu) & 0x10101010u) != 0x10101010u;
  }

  bool children_significant(const Node& node) const {
    const std::size_t first = coding_.state.level_begin(node.level + 1) + 4 * node.index;
    bool any = false;
    for (std::size_t k = 0; k < 4; ++k) {
      any = any || coding_.details.tree_significant(channel_, first + k);
    }
    return any;
  }

  void activate(int level) {
    if (level >= coding_.state.active_levels(channel_)) coding_.state.activate(channel_, level);
  }
  std::size_t cell(const Node& node) const {
    return coding_.state.level_begin(node.level) + node.index;
  }
  static bool has_found(const Node& node) { return ((node.found >> node.level) & 1) != 0; }
  int kind() const { return DetailCoding<Details>::kind(channel_); }
  int height(const Node& node) const {
    return std::min(coding_.state.levels() - 1 - node.level, DetailContexts::kHeights - 1);
  }
  int quiet_class(const Node& node) const {
    const ChannelCells& cells = coding_.state.cells(channel_, node.level);
    return kQuietClass[std::min(255, cells.around[node.index] + cells.above[node.index])];
  }

  DetailCoding<Details>& coding_;
  bool begun_ = false;
  int channel_ = 0;
  Node node_;
};

}  // namespace zerotree::bitstream
