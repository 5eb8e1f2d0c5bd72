#include "lattice/level_schedule.h"

#include <algorithm>
#include <atomic>

namespace zerotree::surface {

namespace {

constexpr std::array kLevelPasses = {
    SynthesisPass::subdivide_strips, SynthesisPass::subdivide_corners,
    SynthesisPass::subdivide_groups, SynthesisPass::move_strips,
    SynthesisPass::move_groups,      SynthesisPass::lift_strips,
    SynthesisPass::lift_corners,     SynthesisPass::finish_strips,
    SynthesisPass::finish_corners,   SynthesisPass::finish_groups,
};
constexpr std::size_t kPassesWithoutDetails = 3;
constexpr std::array kLimitPasses = {
    SynthesisPass::limit_strips,
    SynthesisPass::limit_corners,
    SynthesisPass::limit_groups,
};

bool has_passed(const Deadline& deadline) {
  return deadline && std::chrono::steady_clock::now() >= *deadline;
}

}  // namespace

LevelSchedule::LevelSchedule(LatticeMesh& mesh, const Jobs& jobs, std::pmr::memory_resource* memory)
    : mesh_(mesh), jobs_(jobs), synthesis_(mesh, memory) {}

void LevelSchedule::invalidate(int level) {
  if (level > made_) return;
  // At level == made_ the details that are just being added have changed.
  made_ = level;
  level_place_ = {};
  if (level < limit_target_.level) limit_target_ = {};
}

void LevelSchedule::reserve(int level) {
  if (level <= synthesis_.levels()) return;
  mesh_.deepen(level);
  level_place_ = {};  // what the level being made has of lifts is lost
  synthesis_.reserve(level, jobs_.run ? jobs_.threads : 1);
}

bool LevelSchedule::make_level(int level, const SurfaceSource& source, const Deadline& deadline) {
  reserve(level);
  if (made_ < 0) {
    synthesis_.set_base(source.base_positions);
    made_ = 0;
  }
  while (made_ < level) {
    const auto number = static_cast<std::size_t>(made_);
    const LevelDetails details =
        number < source.details.size() ? source.details[number] : LevelDetails{};
    synthesis_.set_details(
        details, source.base_mean_area / static_cast<double>(std::uint64_t{1} << (2 * made_)));
    const std::span passes(kLevelPasses);
    if (!run(details.any() ? passes : passes.first(kPassesWithoutDetails), made_, {}, deadline,
             level_place_))
      return false;
    level_place_ = {};
    ++made_;
  }
  return true;
}

bool LevelSchedule::write_limits(int level, const SurfaceSource& source, const LimitOutput& output,
                                 const Deadline& deadline) {
  if (!make_level(level, source, deadline)) return false;
  // A whole request writes every vertex, and leaves one in slices where it is.
  Place whole;
  if (!deadline) return run(kLimitPasses, level, output, deadline, whole);
  const LimitTarget target{level, output};
  if (limit_target_ != target) {
    limit_target_ = target;
    limit_place_ = {};
  }
  if (!run(kLimitPasses, level, output, deadline, limit_place_)) return false;
  limit_target_ = {};
  return true;
}

bool LevelSchedule::run(std::span<const SynthesisPass> passes, int level, const LimitOutput& output,
                        const Deadline& deadline, Place& place) {
  for (; place.pass < passes.size(); ++place.pass, place.unit = 0) {
    const SynthesisPass pass = passes[place.pass];
    const std::size_t units = synthesis_.unit_count(pass);
    if (!deadline && jobs_.run && jobs_.threads > 1 && place.unit == 0 && units > 1) {
      run_at_once(pass, level, units, output);
      continue;
    }
    while (place.unit < units) {
      synthesis_.run(pass, level, place.unit++, 0, output);
      // After a unit, not before: whatever the deadline, each call brings the work on.
      if (has_passed(deadline)) return false;
    }
  }
  return true;
}

void LevelSchedule::run_at_once(SynthesisPass pass, int level, std::size_t units,
                                const LimitOutput& output) {
  struct Work {
    LatticeSynthesis& synthesis;
    SynthesisPass pass;
    int level;
    std::size_t units;
    const LimitOutput& output;
    std::atomic<std::size_t> next{0};
  } work{synthesis_, pass, level, units, output};
  const auto take_units = [](void* context, std::uint32_t worker) {
    Work& shared = *static_cast<Work*>(context);
    for (std::size_t unit = shared.next++; unit < shared.units; unit = shared.next++)
      shared.synthesis.run(shared.pass, shared.level, unit, worker, shared.output);
  };
  jobs_.run(jobs_.user, static_cast<std::uint32_t>(std::min<std::size_t>(jobs_.threads, units)),
            take_units, &work);
}

}  // namespace zerotree::surface
