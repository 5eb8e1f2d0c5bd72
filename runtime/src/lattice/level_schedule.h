// What has to be made when: levels are kept, made anew from where details changed, and made in
// slices of time or on many threads.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <optional>
#include <span>

#include "lattice/lattice_synthesis.h"
#include "lattice/level_details.h"
#include "surface/limit_output.h"

namespace zerotree::surface {

/// Somebody else's threads: run(user, count, task, context) calls task(context, i) once for each
/// i < count and returns when all are done. `run` may be null: everything stays on this thread.
struct Jobs {
  using Task = void (*)(void* context, std::uint32_t index);
  void (*run)(void* user, std::uint32_t count, Task task, void* context) = nullptr;
  void* user = nullptr;
  std::uint32_t threads = 1;  ///< calls of a task that are worth making at the same time
};

using Deadline = std::optional<std::chrono::steady_clock::time_point>;

/// What is made of: base points, and the details of each level as they are now.
struct SurfaceSource {
  std::span<const float> base_positions;
  std::span<const LevelDetails> details;  ///< of levels 0 ..; none beyond
  double base_mean_area = 0.0;
};

class LevelSchedule {
 public:
  /// The mesh outlives this.
  LevelSchedule(LatticeMesh& mesh, const Jobs& jobs, std::pmr::memory_resource* memory);

  /// From now on the levels beyond `level` are out of date; -1: all of them, base points too.
  void invalidate(int level);

  /// Makes the control points of levels up to `level`. False: the deadline came first; the next
  /// call goes on.
  bool make_level(int level, const SurfaceSource& source, const Deadline& deadline);
  /// The same, and writes that level's limit positions and normals; goes on only with the same
  /// level and output as before.
  bool write_limits(int level, const SurfaceSource& source, const LimitOutput& output,
                    const Deadline& deadline);

  const LatticePoints& points(int level) const { return synthesis_.points(level); }

 private:
  /// Where in a list of passes the work stands.
  struct Place {
    std::size_t pass = 0, unit = 0;
  };
  struct LimitTarget {
    int level = -1;
    LimitOutput output;
    friend bool operator==(const LimitTarget&, const LimitTarget&) = default;
  };

  void reserve(int level);
  bool run(std::span<const SynthesisPass> passes, int level, const LimitOutput& output,
           const Deadline& deadline, Place& place);
  void run_at_once(SynthesisPass pass, int level, std::size_t units, const LimitOutput& output);

  LatticeMesh& mesh_;
  Jobs jobs_;
  LatticeSynthesis synthesis_;
  int made_ = -1;  ///< levels up to this one are up to date
  Place level_place_, limit_place_;
  LimitTarget limit_target_;
};

}  // namespace zerotree::surface
