#include "domain/bulk_decimation.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace zerotree::domain {
namespace {

// A pass looks at this share of the vertices. Less comes closer to the strict order of costs, more
// needs fewer passes.
constexpr double kShareOfPass = 0.5;
// A pass that collapses, and looks anew at, less than this share of the vertices isn't worth its
// sweep.
constexpr double kLeastShareOfPass = 0.01;
constexpr std::size_t kGrain = 512;
// The order of costs leaps through memory: what a collapse needs is asked for so many before.
constexpr std::size_t kAhead = 8;

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
    std::ranges::sort(order_);
    chosen_.clear();
    for (std::size_t i = 0; i < order_.size() && chosen_.size() < most; ++i) {
      if (i + kAhead < order_.size()) prefetch(static_cast<std::uint32_t>(order_[i + kAhead]));
      choose(static_cast<std::uint32_t>(order_[i]));
    }
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

  void prefetch(std::uint32_t vertex) const {
    const std::uint32_t face = state_.topology.face_of_vertex[vertex];
    __builtin_prefetch(&state_.topology.faces[face]);
    __builtin_prefetch(&state_.topology.adjacent[face]);
    __builtin_prefetch(&choices_[vertex]);
    __builtin_prefetch(&touched_[vertex]);
  }

  // Chooses the collapse for this pass unless one chosen before, or since its cost was found,
  // changes a vertex of its two faces: if not, their valences and links are as they were then.
  void choose(std::uint32_t vertex) {
    Choice& choice = choices_[vertex];
    const auto is_touched = [&](std::uint32_t v) {
      return v != kNone && touched_[v] >= choice.pass;
    };
    const auto is_outdated = [&] {
      if (choice.pass == 0 || is_touched(vertex) || is_touched(choice.kept)) return true;
      const CollapseSite site = searcher_.site_into(vertex, choice.kept);
      return is_touched(site.left_apex) || is_touched(site.right_apex);
    };
    if (is_outdated()) {
      choice.pass = 0;
      return;
    }
    touch(vertex);
    for (std::uint32_t v : searcher_.ring()) touch(v);
    chosen_.push_back(vertex);
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
