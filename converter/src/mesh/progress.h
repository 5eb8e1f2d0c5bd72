// How long work tells a person where it is.
#pragma once

#include <functional>
#include <string_view>

namespace zerotree {

/// Called with the name of the current step ("decimating") and the share of it that is done, in
/// 0..1. Called from the thread that runs the stage; may be empty. Must not throw.
using Progress = std::function<void(std::string_view step, double share)>;

/// Calls `progress` if there is one.
inline void report_progress(const Progress& progress, std::string_view step, double share) {
  if (progress) progress(step, share);
}

}  // namespace zerotree
