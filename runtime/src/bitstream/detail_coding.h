// What the passes over the details share: state, contexts, and the sign of a new significance.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>

#include "bitstream/detail_contexts.h"
#include "bitstream/detail_state.h"

namespace zerotree::bitstream {

/// What the decoder puts in the place of the coefficients that the encoder knows. A cell is given
/// by its place in a CoefficientSet's channel.
struct UnknownDetails {
  bool significant(int, std::size_t, int) const { return false; }
  bool negative(int, std::size_t) const { return false; }
  bool bit(int, std::size_t, int) const { return false; }
  bool tree_significant(int, std::size_t) const { return false; }
  void begin_cleanup(const DetailState&, int) {}
};

/// Details is UnknownDetails or the encoder's: `significant` tells whether a magnitude reaches
/// 2^plane, `bit` its bit of that plane, `tree_significant` whether a cell or one below it that is
/// open becomes significant in the cleanup that began last.
template <class Details>
class DetailCoding {
 public:
  DetailCoding(DetailState& detail_state, Details known)
      : state(detail_state), details(std::move(known)) {}

  /// Codes the sign of a cell that turned out to be significant, and makes it so. False means that
  /// the coder is starved.
  template <class BitCoder>
  bool code_sign(BitCoder& coder, int plane, int level, int c, std::size_t index) {
    const bool truth = details.negative(c, state.level_begin(level) + index);
    const bool negative = coder.code_even(truth, sign_context(level, c, index));
    if (coder.starved()) return false;
    state.set_significant(c, level, index, plane, negative);
    return true;
  }

  static int kind(int c) { return c == kNormal ? 0 : 1; }
  int level_class(int level) const { return level + 1 == state.levels() ? 2 : level == 0 ? 0 : 1; }

  DetailState& state;
  Details details;
  DetailContexts contexts;

 private:
  AdaptiveBit& sign_context(int level, int c, std::size_t index) {
    const int parent = level == 0 ? 0 : sign_class(state.value(c, level - 1, index / 4));
    if (c == kNormal) {
      const int lean = lean_class(state.cells(c, level).lean[index]);
      return contexts.normal_sign[lean][parent][level + 1 == state.levels() ? 1 : 0];
    }
    const int sibling = level == 0 ? 0 : sign_class(state.value(c, level, index ^ 3));
    return contexts.tangent_sign[c - kTangent1][parent][sibling];
  }
};

}  // namespace zerotree::bitstream
