#include "remesh/parameterisation.h"

#include <algorithm>
#include <span>

#include "remesh/relaxation_sweeps.h"
#include "remesh/vertex_insertion.h"

namespace zerotree::remesh {
namespace {

// Sweeps of relaxation each time that the number of vertices has doubled.
constexpr int kSweeps = 2;
// ... and when all vertices are there: on meshes of few vertices, CAD-like ones, this makes the
// tangential details a fifth smaller; more of them shift stretch to where the surface bends.
constexpr int kFinalSweeps = 4;
// Newton steps for the neighbours of a vertex that has little room.
constexpr int kStepsOfSqueezed = 3;

// Gives the vertices around a squeezed one more room.
void relax_ring(ConeCharts& charts, const domain::Star& star, VertexRelaxation& relaxation) {
  for (const auto& [face, corner] : star.corners)
    relaxation.relax(charts, charts.topology.faces[face][kNext[corner]], kStepsOfSqueezed);
  const auto& [face, corner] = star.corners.front();
  relaxation.relax(charts, charts.topology.faces[face][corner], kStepsOfSqueezed);
}

// Undoes `collapses` from the last to the first on the charts of `laid_out`, which has `present`
// vertices already.
void undo_collapses(const domain::Domain& domain,
                    std::span<const domain::CollapseRecord> collapses, std::size_t present,
                    Parameterisation& laid_out, const Progress& progress) {
  const std::vector<Eigen::Vector3d>& positions = domain.mesh.positions;
  VertexInsertion insertion(laid_out.base, positions, domain.kinds);
  RelaxationSweeps sweeps(laid_out.base, positions, domain.kinds);
  VertexRelaxation single_relaxation(laid_out.base, positions, domain.kinds);
  domain::Star neighbours;
  // Sweeps come when half of the vertices are there, a quarter, and so on.
  const std::size_t all = present + collapses.size();
  std::size_t due = all;
  while (due / 2 > present) due /= 2;
  for (std::size_t i = collapses.size(); i-- > 0;) {
    if (!insertion.insert(laid_out.charts, collapses[i])) {
      laid_out.stuck = i + 1;
      break;
    }
    if (insertion.is_squeezed()) {
      neighbours = insertion.star();
      relax_ring(laid_out.charts, neighbours, single_relaxation);
    }
    if (++present < due) continue;
    report_progress(progress, "parameterising",
                    static_cast<double>(present) / static_cast<double>(all));
    sweeps.run(laid_out.charts, i == 0 ? kFinalSweeps : kSweeps);
    due = present == all ? all : std::min(2 * due + 1, all);
  }
  laid_out.cone_swaps += insertion.cone_swaps();
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
  undo_collapses(domain, domain.collapses, result.base.mesh_vertex.size(), result, progress);
  return result;
}

Parameterisation refine(const domain::Domain& fine, const domain::CoarseDomain& coarse,
                        const Parameterisation& laid_out, const Progress& progress) {
  Parameterisation result{laid_out.base, embed_charts(laid_out.charts, coarse, fine),
                          laid_out.cone_swaps, 0};
  for (std::uint32_t& v : result.base.mesh_vertex) v = coarse.vertices[v];
  for (std::uint32_t& f : result.base.mesh_face) f = coarse.faces[f];
  const auto missing = std::span(fine.collapses).first(done_before(coarse, fine));
  undo_collapses(fine, missing, coarse.vertices.size(), result, progress);
  return result;
}

}  // namespace zerotree::remesh
