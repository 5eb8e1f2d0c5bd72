#include "remesh/parameterisation.h"

#include <algorithm>
#include <span>

#include "remesh/collapse_undoing.h"
#include "remesh/relaxation_sweeps.h"

namespace zerotree::remesh {
namespace {

// Sweeps of relaxation each time that the number of vertices has doubled.
constexpr int kSweeps = 2;
// ... and more when all vertices of a mesh of few are there, as CAD-like ones have: this makes the
// tangential details a fifth smaller; still more shift stretch to where the surface bends.
constexpr int kFinalSweepsOfFew = 4;
constexpr std::size_t kFewVertices = 20'000;

// Collapses from `begin` on that can be undone in one go.
struct Run {
  std::size_t begin;
  bool is_independent;
};

// Those before the collapse `left`: of the pass that it ends or is in, or down to the next pass.
Run run_before(const std::vector<domain::CollapsePass>& passes, std::size_t left) {
  const auto after = std::ranges::lower_bound(passes, left, {}, &domain::CollapsePass::begin);
  if (after == passes.begin()) return {0, false};
  const domain::CollapsePass& pass = *std::prev(after);
  return pass.end >= left ? Run{pass.begin, true} : Run{pass.end, false};
}

// Undoes the first `collapses` collapses of `domain`, from the last to the first, on the charts of
// `laid_out`, which has all the other vertices already.
void undo_collapses(const domain::Domain& domain, std::size_t collapses, Parameterisation& laid_out,
                    const Progress& progress) {
  CollapseUndoing undoing(laid_out.base, domain.mesh.positions, domain.kinds);
  RelaxationSweeps sweeps(laid_out.base, domain.mesh.positions, domain.kinds);
  const std::span<const domain::CollapseRecord> records(domain.collapses);
  // Sweeps come when half of the vertices are there, a quarter, and so on.
  const std::size_t all = domain.kinds.size();
  std::size_t due = all;
  while (due / 2 > all - collapses) due /= 2;
  for (std::size_t left = collapses; left > 0;) {
    const Run run = run_before(domain.passes, left);
    const std::size_t first = std::max(run.begin, all - due);
    const auto next = records.subspan(first, left - first);
    if (!(run.is_independent ? undoing.undo_independent(laid_out.charts, next)
                             : undoing.undo(laid_out.charts, next))) {
      laid_out.stuck = first + undoing.stuck() + 1;
      break;
    }
    left = first;
    if (all - left < due) continue;
    report_progress(progress, "parameterising",
                    static_cast<double>(due) / static_cast<double>(all));
    sweeps.run(laid_out.charts, left == 0 && all < kFewVertices ? kFinalSweepsOfFew : kSweeps);
    due = std::min(2 * due + 1, all);
  }
  laid_out.cone_swaps += undoing.cone_swaps();
}

// Collapses of `fine` that were done when `coarse` began.
std::size_t done_before(const domain::CoarseDomain& coarse, const domain::Domain& fine) {
  return fine.kinds.size() - coarse.vertices.size();
}

// The charts of `coarse` as those of a part of `fine`, on the topology of `fine` at that size.
ConeCharts embed_charts(const ConeCharts& charts, const domain::CoarseDomain& coarse,
                        const domain::Domain& fine) {
  ConeCharts result;
  result.topology = fine.topology;
  std::vector<std::uint32_t> fan;
  for (std::size_t i = fine.collapses.size(); i-- > done_before(coarse, fine);)
    domain::undo_collapse(result.topology, fine.collapses[i], fan);
  result.vertices.resize(fine.kinds.size());
  for (std::size_t v = 0; v < coarse.vertices.size(); ++v)
    result.vertices[coarse.vertices[v]] = charts.vertices[v];
  result.transitions.resize(fine.topology.faces.size());
  for (std::size_t f = 0; f < coarse.faces.size(); ++f)
    result.transitions[coarse.faces[f]] = charts.transitions[f];
  return result;
}

}  // namespace

Parameterisation parameterise(const domain::Domain& domain, const Progress& progress) {
  Parameterisation result{build_base_domain(domain), {}, 0, 0};
  result.charts = build_base_charts(domain, result.base);
  undo_collapses(domain, domain.collapses.size(), result, progress);
  return result;
}

Parameterisation refine(const domain::Domain& fine, const domain::CoarseDomain& coarse,
                        const Parameterisation& laid_out, const Progress& progress) {
  Parameterisation result{laid_out.base, embed_charts(laid_out.charts, coarse, fine),
                          laid_out.cone_swaps, 0};
  for (std::uint32_t& v : result.base.mesh_vertex) v = coarse.vertices[v];
  for (std::uint32_t& f : result.base.mesh_face) f = coarse.faces[f];
  undo_collapses(fine, done_before(coarse, fine), result, progress);
  return result;
}

}  // namespace zerotree::remesh
