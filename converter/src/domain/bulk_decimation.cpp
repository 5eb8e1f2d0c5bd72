#include "domain/bulk_decimation.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <span>

namespace zerotree::domain {
namespace {

// A pass looks at this share of the vertices. Less comes closer to the strict order of costs, more
// needs fewer passes.
constexpr double kShareOfPass = 0.5;
// A pass that collapses, and looks anew at, less than this share of the vertices isn't worth its
// sweep.
constexpr double kLeastShareOfPass = 0.01;
constexpr std::size_t kGrain = 512;
// Parts of the mesh in which collapses are chosen in parallel: few enough that most lie inside one,
// small enough for the cache. They do not depend on the number of threads.
constexpr std::size_t kParts = 32;
constexpr std::size_t kLeastInParallel = 16384;

class BulkDecimation {
 public:
  explicit BulkDecimation(DecimationState& state)
      : state_(state),
        choices_(state.kinds.size()),
        touched_(state.kinds.size(), 0),
        searcher_(state) {
    for (std::uint32_t v = 0; v < choices_.size(); ++v)
      if (!state.fixed[v]) free_.push_back(v);
    candidates_ = free_;
    update_costs();
  }

  // Returns how many collapses were done.
  std::size_t pass(std::size_t most) {
    ++pass_;
    std::erase_if(free_, [&](std::uint32_t v) { return state_.fixed[v] != 0; });
    const float limit = cost_limit();
    candidates_.clear();
    for (std::uint32_t v : free_)
      if (choices_[v].cost <= limit) candidates_.push_back(v);
    updates_ = static_cast<std::size_t>(
        std::ranges::count_if(candidates_, [&](std::uint32_t v) { return choices_[v].pass == 0; }));
    update_costs();
    order_.clear();
    for (std::uint32_t v : candidates_)
      if (choices_[v].cost <= limit) order_.push_back(sort_key(choices_[v].cost, v));
    chosen_.clear();
    if (order_.size() >= kLeastInParallel && order_.size() <= most) choose_in_parts();
    choose_in_order(most);
    // They don't touch each other, so that their order is free: that of the vertices is the one in
    // which this and the undo find their surroundings in the cache.
    std::ranges::sort(chosen_);
    const std::size_t begin = state_.records.size();
    state_.passes.push_back({begin, begin + chosen_.size()});
    for (std::uint32_t v : chosen_) {
      const CollapseSite site = searcher_.site_into(v, choices_[v].kept);
      state_.apply(searcher_.star(), site);
    }
    return chosen_.size();
  }

  std::size_t free_count() const { return free_.size(); }
  // Costs that the last pass brought up to date.
  std::size_t updates() const { return updates_; }

 private:
  // The cheapest collapse of a vertex as it was when last looked at. Costs mostly rise, so that one
  // out of date serves as a lower bound.
  struct Choice {
    float cost = 0;
    std::uint32_t kept = kNone;
    std::uint16_t pass = 0;  // after which it was looked at; 0: it's out of date
  };

  float cost_limit() {
    costs_.clear();
    for (std::uint32_t v : free_)
      if (std::isfinite(choices_[v].cost)) costs_.push_back(choices_[v].cost);
    if (costs_.empty()) return 0;
    const auto at = costs_.begin() + static_cast<std::ptrdiff_t>(
                                         kShareOfPass * static_cast<double>(costs_.size() - 1));
    std::ranges::nth_element(costs_, at);
    return *at;
  }

  void update_costs() {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, candidates_.size(), kGrain),
                      [&](const tbb::blocked_range<std::size_t>& range) {
                        CollapseChoice searcher(state_);
                        for (std::size_t i = range.begin(); i != range.end(); ++i) {
                          Choice& choice = choices_[candidates_[i]];
                          if (choice.pass != 0) continue;
                          CollapseSite site;
                          const double cost = searcher.cheapest(candidates_[i], {}, site);
                          choice = {static_cast<float>(cost), site.kept, pass_};
                        }
                      });
  }

  // Costs are not negative, so that their bits are in their order; of equals the lower vertex.
  static std::uint64_t sort_key(float cost, std::uint32_t vertex) {
    return (std::uint64_t{std::bit_cast<std::uint32_t>(cost)} << 32) | vertex;
  }

  static std::uint32_t vertex_of(std::uint64_t key) { return static_cast<std::uint32_t>(key); }

  // Of the collapses in order_, by the order of costs.
  void choose_in_order(std::size_t most) {
    std::ranges::sort(order_);
    for (std::size_t i = 0; i < order_.size() && chosen_.size() < most; ++i)
      if (judge(
              vertex_of(order_[i]), [](std::uint32_t) { return true; }, searcher_) ==
          Verdict::chosen)
        chosen_.push_back(vertex_of(order_[i]));
  }

  // ... in each part those that touch no vertex of another one. The others stay in order_, which
  // must be in the order of the vertices.
  void choose_in_parts() {
    struct Part {
      std::span<std::uint64_t> keys;
      std::vector<std::uint32_t> chosen;
      std::vector<std::uint64_t> at_border;
    };
    std::array<Part, kParts> parts;
    const auto part_of = [&](std::uint32_t v) { return v * kParts / choices_.size(); };
    for (std::size_t part = 0; part < kParts; ++part)
      parts[part].keys = std::ranges::equal_range(
          order_, part, {}, [&](std::uint64_t key) { return part_of(vertex_of(key)); });
    tbb::parallel_for(std::size_t{0}, kParts, [&](std::size_t part) {
      std::ranges::sort(parts[part].keys);
      CollapseChoice searcher(state_);
      for (std::uint64_t key : parts[part].keys) {
        const Verdict verdict = judge(
            vertex_of(key), [&](std::uint32_t v) { return part_of(v) == part; }, searcher);
        if (verdict == Verdict::chosen) parts[part].chosen.push_back(vertex_of(key));
        if (verdict == Verdict::at_border) parts[part].at_border.push_back(key);
      }
    });
    order_.clear();
    for (const Part& part : parts) {
      chosen_.insert(chosen_.end(), part.chosen.begin(), part.chosen.end());
      order_.insert(order_.end(), part.at_border.begin(), part.at_border.end());
    }
  }

  enum class Verdict { chosen, outdated, at_border };

  // Chooses the collapse for this pass unless one chosen before, or since its cost was found,
  // changes a vertex of its two faces: if not, their valences and links are as they were then.
  // Changes nothing, and looks at no choice, that is not `inside`.
  template <typename Inside>
  Verdict judge(std::uint32_t vertex, const Inside& inside, CollapseChoice& searcher) {
    Choice& choice = choices_[vertex];
    const auto is_touched = [&](std::uint32_t v) {
      return v != kNone && touched_[v] >= choice.pass;
    };
    if (choice.pass == 0 || is_touched(vertex)) return outdate(choice);
    if (!inside(choice.kept)) return Verdict::at_border;
    if (is_touched(choice.kept)) return outdate(choice);
    const CollapseSite site = searcher.site_into(vertex, choice.kept);
    if (!std::ranges::all_of(searcher.ring(), inside)) return Verdict::at_border;
    if (is_touched(site.left_apex) || is_touched(site.right_apex)) return outdate(choice);
    touch(vertex);
    for (std::uint32_t v : searcher.ring()) touch(v);
    return Verdict::chosen;
  }

  static Verdict outdate(Choice& choice) {
    choice.pass = 0;
    return Verdict::outdated;
  }

  void touch(std::uint32_t vertex) {
    touched_[vertex] = pass_;
    Choice& choice = choices_[vertex];
    choice.pass = 0;
    // What could not be collapsed may now: look again.
    if (!std::isfinite(choice.cost)) choice.cost = 0;
  }

  DecimationState& state_;
  std::vector<Choice> choices_;
  std::vector<std::uint16_t> touched_;  // the last pass that changed the vertex
  std::uint16_t pass_ = 1;
  std::vector<std::uint32_t> free_, candidates_, chosen_;
  std::vector<std::uint64_t> order_;
  std::vector<float> costs_;
  std::size_t updates_ = 0;
  CollapseChoice searcher_;
};

}  // namespace

void decimate_in_bulk(DecimationState& state, std::size_t target, const Progress& progress) {
  if (state.vertex_count() <= target) return;
  BulkDecimation bulk(state);
  for (int i = 0; i < std::numeric_limits<std::uint16_t>::max() - 1; ++i) {
    report_progress(
        progress, "decimating",
        static_cast<double>(state.records.size()) / static_cast<double>(state.positions.size()));
    const std::size_t above = state.vertex_count() - target;
    const std::size_t done = bulk.pass(above);
    const double least = kLeastShareOfPass * static_cast<double>(bulk.free_count());
    if (done == above || static_cast<double>(done + bulk.updates()) <= least) return;
  }
}

}  // namespace zerotree::domain
