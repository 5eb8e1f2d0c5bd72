// Drives a coder by hand.
#pragma once

#include <cstddef>
#include <string_view>

#include "conformance_cases.h"
#include "encode/range_encoder.h"

namespace zerotree::conformance {

/// A bit coder (bitstream/base_connectivity_coding.h) whose answers are chosen beforehand: a
/// decoder that runs on it takes them, and the bytes that say so are written.
class ChosenDecisions {
 public:
  /// '0' and '1', one per decision; it is starved after the last. The text must stay.
  explicit ChosenDecisions(std::string_view decisions) : decisions_(decisions) {}

  bool code(bool, bitstream::AdaptiveBit& context) {
    return next() && encoder_.code(bit_, context);
  }
  bool code_raw(bool) { return next() && encoder_.code_raw(bit_); }
  bool starved() const { return starved_; }

  /// Decisions that were asked for.
  std::size_t used() const { return used_; }
  Bytes finish() { return encoder_.finish(); }

 private:
  bool next() {
    starved_ = used_ == decisions_.size();
    if (!starved_) bit_ = decisions_[used_++] == '1';
    return !starved_;
  }

  std::string_view decisions_;
  encode::RangeEncoder encoder_;
  std::size_t used_ = 0;
  bool bit_ = false;
  bool starved_ = false;
};

}  // namespace zerotree::conformance
