// The first bytes of an input of the fuzzer: how the stream that follows them is decoded.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace zerotree::fuzz {

/// Where the stream's base comes from.
enum class BaseChoice : std::uint8_t {
  embedded,
  first_known,  // fuzz_base(0), and so on
  last_known = first_known + 3,
  hostile_positions,  // of fuzz_base(0), out of the bytes before the stream
  hostile,            // positions and indices out of those bytes
  count
};

struct FuzzPlan {
  static constexpr std::size_t kSteps = 24;

  std::uint8_t base = 0;     ///< a BaseChoice
  std::uint8_t levels = 0;   ///< what is said of a stream with an external base
  std::uint8_t limits = 0;   ///< bits 0, 1: most vertices; bits 2, 3: most levels
  std::uint8_t failing = 0;  ///< allocations until the allocator fails; 0: it never does
  std::uint8_t workers = 0;  ///< of the job system; below 2: there is none
  std::uint8_t seed = 0;     ///< of the order of tasks and of strides
  /// What is done, again and again: see FuzzRun::step.
  std::array<std::uint8_t, kSteps> steps{};

  static constexpr std::size_t kBytes = 6 + kSteps;

  /// Zeros where `bytes` end; takes what it reads off their front.
  static FuzzPlan read(std::span<const std::uint8_t>& bytes) {
    std::array<std::uint8_t, kBytes> all{};
    const std::size_t there = std::min(kBytes, bytes.size());
    std::copy_n(bytes.begin(), there, all.begin());
    bytes = bytes.subspan(there);
    FuzzPlan plan{all[0], all[1], all[2], all[3], all[4], all[5], {}};
    std::copy_n(all.begin() + 6, kSteps, plan.steps.begin());
    return plan;
  }
  std::array<std::uint8_t, kBytes> bytes() const {
    std::array<std::uint8_t, kBytes> all{base, levels, limits, failing, workers, seed};
    std::copy_n(steps.begin(), kSteps, all.begin() + 6);
    return all;
  }
};

}  // namespace zerotree::fuzz
