#include "relax/surface_relaxation.h"

#include <algorithm>

#include "relax/guarded_move.h"
#include "relax/relaxation_steps.h"
#include "relax/surface_vertices.h"

namespace zerotree::relax {
namespace {

// The coarsest level that moves: steps of whole base triangles would tear the parameterisation.
constexpr int kFirstLevel = 2;
// It feels the geometry so many levels finer: a level alone loses what lies between its vertices,
// such as the tips of ears.
constexpr int kForceDepth = 2;
// New vertices go so often towards the place that Loop's rule predicts ...
constexpr int kPredictionSteps = 2;
// ... and each cycle ends by going this share of the way once more, which lowers tangential details
// by a third.
constexpr double kLastPrediction = 0.7;

}  // namespace

RelaxedMesh relax(const domain::Domain& domain, const remesh::Parameterisation& laid_out,
                  int levels, const RelaxOptions& options, const Progress& progress) {
  RelaxedMesh result;
  result.levels = subdivide_base(laid_out.base.topology, levels);
  const bool moves = options.steps > 0 && levels > 0;
  const int first = std::min(levels, kFirstLevel);
  SurfaceVertices vertices(domain, laid_out, result.levels,
                           moves ? std::min(levels, first + kForceDepth) : levels);
  RelaxationSteps steps;
  GuardedMove guarded;
  const auto relax_level = [&](int level, int count) {
    for (int i = 0; i < count; ++i) guarded.move(vertices, steps.towards_means(vertices, level));
  };
  const auto go_to_prediction = [&](double share) {
    guarded.move(vertices, steps.towards_prediction(vertices, share));
  };
  for (int coarsest = first; moves; coarsest = vertices.level() - 1) {
    report_progress(progress, "relaxing", static_cast<double>(vertices.level()) / (levels + 1));
    // A V-cycle: what is rough must be smooth before it can move together.
    for (int l = vertices.level(); l > coarsest; --l) relax_level(l, options.steps / 2);
    for (int l = coarsest; l <= vertices.level(); ++l) relax_level(l, options.steps);
    go_to_prediction(kLastPrediction);
    if (vertices.level() == levels) break;
    vertices.refine();
    for (int i = 0; i < kPredictionSteps; ++i) go_to_prediction(1.0);
  }
  result.report = {guarded.rejected(), vertices.count_negative()};
  result.mesh = {laid_out.base.topology, levels, vertices.positions()};
  result.points = vertices.points();
  return result;
}

}  // namespace zerotree::relax
