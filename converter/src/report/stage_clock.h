// Measures time and peak memory of each stage.
#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "report/convert_report.h"

namespace zerotree::report {

/// Highest resident memory of this process since the last reset, in bytes; 0 where the system
/// does not tell.
std::uint64_t peak_memory();
/// Starts a new peak (Linux; elsewhere the peak of the whole run stays).
void reset_peak_memory();

/// Runs stages and keeps what each cost.
class StageClock {
 public:
  /// Runs `stage()` and appends its cost to `costs()`; returns what the stage returns.
  template <class Stage>
  auto run(const std::string& name, Stage&& stage) {
    const Scope scope(*this, name);
    return stage();
  }
  const std::vector<StageCost>& costs() const { return costs_; }

 private:
  struct Scope {
    Scope(StageClock& owner, std::string stage_name)
        : clock(owner), name(std::move(stage_name)), start(std::chrono::steady_clock::now()) {
      reset_peak_memory();
    }
    ~Scope() {
      const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
      clock.costs_.push_back({name, time.count(), peak_memory()});
    }
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

    StageClock& clock;
    std::string name;
    std::chrono::steady_clock::time_point start;
  };

  std::vector<StageCost> costs_;
};

}  // namespace zerotree::report
