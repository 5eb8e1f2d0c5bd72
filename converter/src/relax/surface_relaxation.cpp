#include "relax/surface_relaxation.h"

#include <algorithm>
#include <cstddef>
#include <limits>

#include "relax/guarded_move.h"
#include "relax/relaxation_steps.h"
#include "relax/surface_vertices.h"

namespace zerotree::relax {
namespace {

// The coarsest level that moves: steps of whole base triangles would tear the parameterisation.
constexpr int kCoarsestLevel = 2;
// Work begins so many levels finer. A level alone loses what lies between its vertices, such as the
// tips of ears: the cycle after the first one reaches down to the coarsest level once more.
constexpr int kFirstDepth = 1;
// Each cycle begins smoother than the one before and takes so many times fewer steps.
constexpr int kFewerSteps = 3;
// New vertices go to the place that Loop's rule predicts, and each cycle ends by going this share
// of the way once more, which lowers tangential details by a third. The finest level does without,
// and without steps of its own, where it comes in a cycle after the first: it begins smooth, and
// the fit goes on from there.
constexpr double kLastPrediction = 0.7;

// Where sampling or refining has left turned triangles, mostly at squeezed base vertices.
void untangle(SurfaceVertices& vertices, RelaxationSteps& relaxation, GuardedMove& guarded) {
  const std::vector<std::uint32_t> tangled = vertices.find_negative();
  if (!tangled.empty())
    guarded.move_alone(vertices, relaxation.towards_means(vertices, vertices.level()), tangled);
}

}  // namespace

RelaxedMesh relax(const domain::Domain& domain, const remesh::Parameterisation& laid_out,
                  int levels, const RelaxOptions& options, const Progress& progress) {
  RelaxedMesh result;
  result.levels = subdivide_base(laid_out.base.topology, levels);
  const bool moves = options.steps > 0 && levels > 0;
  const int first = std::min(levels, kCoarsestLevel);
  SurfaceVertices vertices(domain, laid_out, result.levels,
                           moves ? std::min(levels, first + kFirstDepth) : levels);
  RelaxationSteps steps;
  GuardedMove guarded;
  const auto relax_level = [&](int level, int count) {
    for (int i = 0; i < count; ++i) guarded.move(vertices, steps.towards_means(vertices, level));
  };
  const auto go_to_prediction = [&](double share) {
    guarded.move(vertices, steps.towards_prediction(vertices, share));
  };
  int count = options.steps;
  for (int coarsest = first; moves;) {
    report_progress(progress, "relaxing", static_cast<double>(vertices.level()) / (levels + 1));
    // A V-cycle: what is rough must be smooth before it can move together.
    for (int l = vertices.level(); l > coarsest; --l) relax_level(l, count / 2);
    const bool is_last = vertices.level() == levels;
    const bool is_left_to_fit = is_last && levels > kCoarsestLevel + kFirstDepth;
    const int finest = is_left_to_fit ? levels - 1 : vertices.level();
    for (int l = coarsest; l <= finest; ++l) relax_level(l, count);
    if (!is_left_to_fit) go_to_prediction(kLastPrediction);
    untangle(vertices, steps, guarded);
    if (is_last) break;
    vertices.refine();
    go_to_prediction(1.0);
    count = std::max(1, count / kFewerSteps);
    coarsest = vertices.level() == first + kFirstDepth + 1 ? first : vertices.level() - 1;
  }
  result.report = {guarded.rejected(), vertices.count_negative()};
  result.mesh = {laid_out.base.topology, levels, vertices.positions()};
  result.points = vertices.points();
  return result;
}

}  // namespace zerotree::relax
