// A stream that can be encoded again with finer steps.
#pragma once

#include <functional>
#include <memory>

#include "convert/prefix_errors.h"
#include "decode/stream_file.h"
#include "encode/header_writer.h"

namespace zerotree::convert {

/// Encodes with a finest quantisation step, in the input's unit.
using StepEncoder = std::function<decode::StreamFile(double finest_step)>;

/// The whole stream of a model for a finest step that can be halved: one more bit plane, which
/// leaves the prefixes before it as exact as they were.
class RefinableStream {
 public:
  /// Encodes with `step`. It is never made shorter than `shortest_step`. Refers to `how`.
  RefinableStream(StepEncoder encode, double step, double shortest_step,
                  const PrefixMeasurement& how);

  /// Encodes with half of the step; returns false and changes nothing if that is too short.
  bool refine();

  const decode::StreamFile& file() const { return *file_; }
  /// Of the current stream.
  PrefixErrors& errors() { return *errors_; }
  double step() const { return encode::storable_step(step_); }

 private:
  void take(decode::StreamFile file, double step);

  StepEncoder encode_;
  double step_ = 0, shortest_step_;
  const PrefixMeasurement& how_;
  std::unique_ptr<const decode::StreamFile> file_;
  std::unique_ptr<PrefixErrors> errors_;
};

}  // namespace zerotree::convert
