#include "remesh/remesh.h"

#include <algorithm>

#include "domain/base_size.h"
#include "mesh/error.h"
#include "remesh/lattice_numbering.h"
#include "remesh/limb_search.h"

namespace zerotree::remesh {
namespace {

// The base is sought on a coarse version of so many vertices per vertex of the base: enough to see
// every limb.
constexpr std::size_t kCoarsePerBaseVertex = 10;
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

// The base is found, and everything laid out again where that finds no room, on a coarse version of
// the mesh.
class BaseSearch {
 public:
  BaseSearch(const domain::Domain& domain, const Progress& progress, RemeshReport& report)
      : domain_(domain), progress_(progress), report_(report) {}

  Parameterisation run() {
    const std::size_t collapses = domain_.collapses.size();
    std::size_t keep =
        collapses - std::min(collapses, kCoarsePerBaseVertex * domain_.report.base_vertices);
    coarse_ = domain::extract_coarse(domain_, keep);
    // Limbs are not worth a level.
    const std::size_t most_base_faces = domain::largest_base_of_same_depth(
        domain_.base_faces.size(), domain_.mesh.triangles.size());
    for (std::uint32_t v : pin_limbs(coarse_.domain, most_base_faces, progress_))
      pin(coarse_.vertices[v]);
    report_.pinned_limbs = static_cast<std::uint32_t>(pinned_.size());
    while (true) {
      const Parameterisation coarse = lay_out_coarse();
      if (keep == 0) return coarse;
      Parameterisation fine = refine(domain_, coarse_, coarse, progress_);
      if (fine.stuck == 0) return fine;
      keep = go_back(fine.stuck, domain_, [](std::uint32_t v) { return v; });
      coarse_ = domain::extract_coarse(domain_, keep);
      rebuild(0);
    }
  }

 private:
  // Where the undo finds no room, keeps the vertex in the base and starts again.
  Parameterisation lay_out_coarse() {
    Parameterisation result = parameterise(coarse_.domain, progress_);
    while (result.stuck > 0) {
      rebuild(go_back(result.stuck, coarse_.domain,
                      [&](std::uint32_t v) { return coarse_.vertices[v]; }));
      result = parameterise(coarse_.domain, progress_);
    }
    return result;
  }

  // Pins what `domain`, whose vertex v is `fine_vertex(v)`, is stuck at. Returns how many of its
  // collapses stay.
  template <typename FineVertex>
  std::size_t go_back(std::size_t stuck, const domain::Domain& domain,
                      const FineVertex& fine_vertex) {
    if (++report_.rebuilds > kMaxRebuilds)
      throw Error(ExitCode::refused_topology,
                  "no base mesh was found over which the mesh can be laid out; ask for more base "
                  "vertices than " +
                      std::to_string(coarse_.domain.report.base_vertices));
    // A mesh full of features gets stuck often: go back further each time, so that it ends soon.
    const std::size_t last = stuck - 1;
    const std::size_t back =
        report_.rebuilds > kPatience ? kBackSteps * (report_.rebuilds - kPatience) : 0;
    const std::size_t first = last - std::min(last, back);
    for (std::size_t i = first; i <= last; ++i) {
      const std::uint32_t removed = domain.collapses[i].removed;
      if (i == last || domain.kinds[removed] == domain::VertexKind::chain)
        pin(fine_vertex(removed));
    }
    return first;
  }

  void pin(std::uint32_t vertex) {
    pinned_.insert(std::ranges::upper_bound(pinned_, vertex), vertex);
  }

  void rebuild(std::size_t keep) {
    domain::DomainOptions options;
    options.pinned_vertices = domain::to_coarse(coarse_, pinned_);
    domain::rebuild_base(coarse_.domain, options, keep, progress_);
  }

  const domain::Domain& domain_;
  const Progress& progress_;
  RemeshReport& report_;
  domain::CoarseDomain coarse_;
  std::vector<std::uint32_t> pinned_;  // of domain_, ascending
};

}  // namespace

RemeshResult remesh(const domain::Domain& domain, const RemeshOptions& options,
                    const Progress& progress) {
  RemeshResult result;
  result.laid_out = BaseSearch(domain, progress, result.report).run();
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
