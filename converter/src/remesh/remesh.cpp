#include "remesh/remesh.h"

#include <algorithm>

#include "domain/base_size.h"
#include "mesh/error.h"
#include "remesh/lattice_numbering.h"
#include "remesh/limb_search.h"
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
// The undo may ask for so many more base vertices before the mesh is given up.
constexpr std::uint32_t kMaxRebuilds = 300;
// After so many, each goes back over so many collapses more than the one before.
constexpr std::uint32_t kPatience = 16;
constexpr std::uint32_t kBackSteps = 8;
constexpr int kMaxLevels = 12;
constexpr std::uint64_t kMaxVertices = std::uint64_t{1} << 30;
// Rounding in the sum of a base triangle's covered area.
constexpr double kCoverageTolerance = 1e-9;

void count_base(const bitstream::BaseTopology& base, RemeshReport& report) {
  std::vector<std::uint32_t> valences(base.vertex_count, 0);
  for (const Triangle& t : base.triangles)
    for (std::uint32_t v : t) ++valences[v];
  report.base_vertices = base.vertex_count;
  report.base_faces = static_cast<std::uint32_t>(base.triangles.size());
  report.base_crease_edges = static_cast<std::uint32_t>(base.crease_edges.size());
  report.base_corners = static_cast<std::uint32_t>(base.corner_vertices.size());
  report.min_valence = *std::ranges::min_element(valences);
  report.max_valence = *std::ranges::max_element(valences);
}

// Lays the mesh out; where the undo finds no room, keeps the vertex in the base and starts again.
Parameterisation parameterise_somehow(const domain::Domain& domain, const Progress& progress,
                                      RemeshReport& report) {
  domain::Domain retry = domain;
  domain::DomainOptions options;
  options.pinned_vertices = pin_limbs(retry, progress);
  options.base_vertices = domain.report.target_base_vertices;
  report.pinned_limbs = static_cast<std::uint32_t>(options.pinned_vertices.size());
  Parameterisation result = parameterise(retry, progress);
  while (result.stuck > 0) {
    if (++report.rebuilds > kMaxRebuilds)
      throw Error(ExitCode::refused_topology,
                  "no base mesh was found over which the mesh can be laid out; ask for more base "
                  "vertices than " +
                      std::to_string(retry.report.base_vertices));
    // A mesh full of features gets stuck often: go back further each time, so that it ends soon.
    const std::size_t stuck = result.stuck - 1;
    const std::size_t back =
        report.rebuilds > kPatience ? kBackSteps * (report.rebuilds - kPatience) : 0;
    const std::size_t first = stuck - std::min(stuck, back);
    for (std::size_t i = first; i <= stuck; ++i) {
      const std::uint32_t removed = retry.collapses[i].removed;
      if (i == stuck || retry.kinds[removed] == domain::VertexKind::chain)
        options.pinned_vertices.push_back(removed);
    }
    std::ranges::sort(options.pinned_vertices);
    domain::rebuild_base(retry, options, first, progress);
    result = parameterise(retry, progress);
  }
  return result;
}

// Gives the vertices around a squeezed one more room.
void relax_ring(ConeCharts& charts, const domain::Star& star, VertexRelaxation& relaxation) {
  for (const auto& [face, corner] : star.corners)
    relaxation.relax(charts, charts.topology.faces[face][kNext[corner]], kStepsOfSqueezed);
  const auto& [face, corner] = star.corners.front();
  relaxation.relax(charts, charts.topology.faces[face][corner], kStepsOfSqueezed);
}

// Sweeps come when half of the vertices are there, a quarter, and so on down to the base.
bool is_sweep_due(std::size_t inserted, std::size_t all, std::size_t base_vertices) {
  for (std::size_t due = all / 2; due >= base_vertices; due /= 2)
    if (due == inserted) return true;
  return false;
}

}  // namespace

Parameterisation parameterise(const domain::Domain& domain, const Progress& progress,
                              std::size_t undone) {
  Parameterisation result{build_base_domain(domain), {}, 0, 0};
  result.charts = build_base_charts(domain, result.base);
  const std::vector<Eigen::Vector3d>& positions = domain.mesh.positions;
  VertexInsertion insertion(result.base, positions, domain.kinds);
  RelaxationSweeps relaxation(result.base, positions, domain.kinds);
  VertexRelaxation single_relaxation(result.base, positions, domain.kinds);
  domain::Star neighbours;
  const std::size_t all = domain.collapses.size(), collapses = std::min(all, undone);
  const std::size_t base_vertices = std::max<std::size_t>(result.base.mesh_vertex.size(), 1);
  for (std::size_t i = 0; i < collapses; ++i) {
    if (!insertion.insert(result.charts, domain.collapses[all - 1 - i])) {
      result.stuck = all - i;
      return result;
    }
    if (insertion.is_squeezed()) {
      neighbours = insertion.star();
      relax_ring(result.charts, neighbours, single_relaxation);
    }
    const bool is_last = i + 1 == collapses;
    if (!is_last && !is_sweep_due(i + 1, collapses, base_vertices)) continue;
    report_progress(progress, "parameterising",
                    static_cast<double>(i) / static_cast<double>(collapses));
    relaxation.run(result.charts, is_last ? kFinalSweeps : kSweeps);
  }
  result.cone_swaps = insertion.cone_swaps();
  return result;
}

RemeshResult remesh(const domain::Domain& domain, const RemeshOptions& options,
                    const Progress& progress) {
  RemeshResult result;
  result.laid_out = parameterise_somehow(domain, progress, result.report);
  const Parameterisation& laid_out = result.laid_out;
  RemeshReport& report = result.report;
  report.cone_swaps = laid_out.cone_swaps;
  report.bijectivity = check_bijectivity(laid_out.charts, laid_out.base);
  if (report.bijectivity.flipped_faces > 0 ||
      report.bijectivity.worst_coverage > kCoverageTolerance)
    throw Error(ExitCode::internal, "the parameterisation is not one to one: " +
                                        std::to_string(report.bijectivity.flipped_faces) +
                                        " faces are flipped, the worst coverage is off by " +
                                        std::to_string(report.bijectivity.worst_coverage));

  const bitstream::BaseTopology& base = laid_out.base.topology;
  count_base(base, report);
  report.levels = options.levels >= 0
                      ? options.levels
                      : domain::automatic_levels(base.triangles.size(),
                                                 domain.mesh.triangles.size(), options.goal);
  if (report.levels > kMaxLevels || count_finest_vertices(base, report.levels) > kMaxVertices)
    throw Error(ExitCode::usage, std::to_string(report.levels) +
                                     " levels are too many for this mesh; ask for fewer");
  report.finest_vertices = static_cast<std::uint32_t>(count_finest_vertices(base, report.levels));
  return result;
}

}  // namespace zerotree::remesh
