// The order of everything after the header and the connectivity, for encoder and decoder alike.
#pragma once

#include <cstdint>
#include <span>
#include <utility>

#include "bitstream/detail_planes.h"
#include "bitstream/detail_state.h"
#include "bitstream/position_planes.h"
#include "bitstream/sharp_tag_coding.h"
#include "bitstream/stream_header.h"

namespace zerotree::bitstream {

enum class Pass : std::uint8_t {
  sharp_tags,
  initial_positions,
  likely_first,
  likely_second,
  positions,
  refinement,
  cleanup,
  last_positions,
  done,
};

/// One stretch of the stream. `plane` is the details' bit plane, the lowest being 0; before the
/// first one it is the number of planes.
struct PassPlace {
  int plane = 0;
  Pass pass = Pass::sharp_tags;
};

/// Runs the passes one after the other: the sharp tags of the base, the initial planes of
/// an embedded base's positions, then plane by plane the details with one plane of positions
/// between likely passes and refinement (paper, section 3.4: "each remaining bitplane is sent as
/// the zerotrees descend another bit plane"), at last the planes of positions that are left.
template <class BitCoder, class Details>
class CodedPasses {
 public:
  /// The three parts are the caller's and outlive this. `true_positions` is empty in a decoder.
  CodedPasses(const StreamHeader& header, SharpTagCoding& tags, PositionPlanes& positions,
              DetailState& state, Details details, std::span<const std::uint32_t> true_positions)
      : tags_(tags),
        positions_(positions),
        state_(state),
        planes_(state, std::move(details)),
        true_positions_(true_positions),
        initial_left_(header.positions.initial_planes),
        place_{header.planes, Pass::sharp_tags} {
    codes_tags_ = header.has_sharp_tags;
  }

  PassPlace place() const { return place_; }
  bool done() const { return place_.pass == Pass::done; }

  /// Codes the pass at `place` and goes on to the next. False means that the coder is starved; the
  /// next call then goes on within the pass. Not to be called when done.
  bool advance(BitCoder& coder) {
    if (!code(coder)) return false;
    next();
    return true;
  }

 private:
  bool code(BitCoder& coder) {
    switch (place_.pass) {
      case Pass::sharp_tags:
        return !codes_tags_ || tags_.code(coder);
      case Pass::initial_positions:
        for (; initial_left_ > 0; --initial_left_) {
          if (!code_positions(coder)) return false;
        }
        return true;
      case Pass::likely_first:
        return planes_.likely_pass(coder, place_.plane, 0);
      case Pass::likely_second:
        return planes_.likely_pass(coder, place_.plane, 1);
      case Pass::positions:
        return code_positions(coder);
      case Pass::refinement:
        return planes_.refinement_pass(coder, place_.plane);
      case Pass::cleanup:
        return planes_.cleanup_pass(coder, place_.plane);
      case Pass::last_positions:
        while (positions_.unknown_planes() > 0) {
          if (!code_positions(coder)) return false;
        }
        return true;
      case Pass::done:
        break;
    }
    return true;
  }

  bool code_positions(BitCoder& coder) {
    return positions_.unknown_planes() == 0 || positions_.code_plane(coder, true_positions_);
  }

  void next() {
    const bool plane_ends = place_.pass == Pass::initial_positions || place_.pass == Pass::cleanup;
    if (!plane_ends) {
      place_.pass = static_cast<Pass>(static_cast<int>(place_.pass) + 1);
    } else if (place_.plane == 0) {
      place_.pass = Pass::last_positions;
    } else {
      place_ = {place_.plane - 1, Pass::likely_first};
      state_.begin_plane();
    }
  }

  SharpTagCoding& tags_;
  PositionPlanes& positions_;
  DetailState& state_;
  DetailPlanes<BitCoder, Details> planes_;
  std::span<const std::uint32_t> true_positions_;
  bool codes_tags_ = false;
  int initial_left_ = 0;
  PassPlace place_;
};

}  // namespace zerotree::bitstream
