#include "convert/refinable_stream.h"

#include <utility>

#include "mesh/error.h"

namespace zerotree::convert {

RefinableStream::RefinableStream(StepEncoder encode, double step, double shortest_step,
                                 const PrefixMeasurement& how)
    : encode_(std::move(encode)), shortest_step_(shortest_step), how_(how) {
  take(encode_(step), step);
}

bool RefinableStream::refine() {
  if (step_ / 2 < shortest_step_) return false;
  try {
    take(encode_(step_ / 2), step_ / 2);
  } catch (const Error& error) {
    // The format holds no integers that long.
    if (error.code() != ExitCode::target_not_reachable) throw;
    return false;
  }
  return true;
}

void RefinableStream::take(decode::StreamFile file, double step) {
  file_ = std::make_unique<const decode::StreamFile>(std::move(file));
  errors_ = std::make_unique<PrefixErrors>(*file_, how_);
  step_ = step;
}

}  // namespace zerotree::convert
