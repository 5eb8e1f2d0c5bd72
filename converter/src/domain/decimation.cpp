#include "domain/decimation.h"

#include <algorithm>
#include <cmath>

#include "domain/bulk_decimation.h"
#include "domain/collapse_choice.h"
#include "domain/indexed_heap.h"

namespace zerotree::domain {
namespace {

// What is still allowed when nothing else is left to collapse above the target. Smooth vertices get
// no valence below 5 or above 7 at first.
constexpr CollapseCaps kCaps[] = {
    {.irregularity = 0},
    {},
    {.valence = 8, .sector = 4, .corner_sector = 3, .fan_share = 0.75},
    {.valence = 8, .sector = 5, .corner_sector = 4, .fan_share = 0.75, .forbid_flips = false}};

// From so many vertices per vertex of the base on, collapses are done one by one and costs are kept
// exact: the base gets better by several percent of the rate.
constexpr std::size_t kExactPerBaseVertex = 16;
// From so many times the base on, valences get no worse. Sooner, and limbs would lose their tips.
constexpr double kRegularPerBaseVertex = 1.5;

class Decimator {
 public:
  Decimator(DecimationState& state, std::size_t target)
      : state_(state),
        choice_(state),
        heap_(static_cast<std::uint32_t>(state.kinds.size())),
        exact_below_(kExactPerBaseVertex * target) {}

  void run(const CollapseCaps& caps, std::size_t target, const Progress& progress) {
    caps_ = caps;
    if (state_.vertex_count() <= target) return;
    for (std::uint32_t v = 0; v < state_.fixed.size(); ++v) update(v);
    while (!heap_.empty() && state_.vertex_count() > target) {
      if (state_.records.size() % 65536 == 0)
        report_progress(progress, "decimating",
                        static_cast<double>(state_.records.size()) /
                            static_cast<double>(state_.positions.size()));
      collapse_cheapest();
    }
  }

 private:
  void update(std::uint32_t vertex) {
    if (state_.fixed[vertex]) return;
    CollapseSite site;
    const double cost = choice_.cheapest(vertex, caps_, site);
    if (std::isfinite(cost))
      heap_.set(vertex, cost);
    else
      heap_.remove(vertex);
  }

  void collapse_cheapest() {
    const std::uint32_t vertex = heap_.top();
    CollapseSite site;
    const double cost = choice_.cheapest(vertex, caps_, site);
    // Costs two rings away may be out of date: look again before acting.
    if (!std::isfinite(cost)) return heap_.remove(vertex);
    if (cost > heap_.cost(vertex) * (1 + 1e-9)) return heap_.set(vertex, cost);
    heap_.remove(vertex);
    state_.apply(choice_.star(), site);
    gather_star(state_.topology, site.kept, kept_star_);
    update(site.kept);
    // The others' costs have mostly risen, which is seen when their turn comes; only those that had
    // no collapse may have one now. Near the end, where each vertex counts, all are looked at.
    const bool near_end = state_.vertex_count() < exact_below_;
    const auto revive = [&](std::uint32_t v) {
      if (near_end || !heap_.contains(v)) update(v);
    };
    for (const auto& [face, corner] : kept_star_.corners) {
      revive(state_.topology.faces[face][kNext[corner]]);
      if (!kept_star_.closed) revive(state_.topology.faces[face][kPrev[corner]]);
    }
  }

  DecimationState& state_;
  CollapseChoice choice_;
  IndexedHeap heap_;
  std::size_t exact_below_;
  CollapseCaps caps_;
  Star kept_star_;
};

}  // namespace

void decimate(Domain& domain, const std::vector<std::uint32_t>& pinned, std::uint32_t target,
              const Progress& progress) {
  DecimationState state(domain, pinned, target);
  const std::size_t count = state.positions.size();
  domain.collapses.reserve(count - std::min<std::size_t>(target, count));
  decimate_in_bulk(state, kExactPerBaseVertex * std::size_t{target}, progress);
  Decimator decimator(state, target);
  decimator.run({}, static_cast<std::size_t>(kRegularPerBaseVertex * target), progress);
  for (const CollapseCaps& caps : kCaps) decimator.run(caps, target, progress);
}

std::vector<std::uint8_t> mark_removed_faces(const Domain& domain) {
  std::vector<std::uint8_t> removed(domain.topology.faces.size(), 0);
  for (const CollapseRecord& collapse : domain.collapses)
    for (std::uint32_t face : {collapse.left, collapse.right})
      if (face != kNone) removed[face] = 1;
  return removed;
}

}  // namespace zerotree::domain
