#include "fit/surface_fit.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <utility>

#include "fit/nearest_samples.h"
#include "fit/normal_equations.h"
#include "fit/stray_faces.h"
#include "fit/turned_faces.h"

namespace zerotree::fit {
namespace {

// Steps p <- p + (s - limit(p)) that bring the limit surface near the samples: smooth waves are
// reproduced, the roughest noise is amplified by at most 4 (1 - (3/4)^4).
constexpr int kInterpolationSteps = 3;

// Details of coarser levels are shape: to pull at them would move the surface off the input.
constexpr int kCoarsestSmoothLevel = 3;

Points interpolate(const LimitOperator& limit, Points samples) {
  Points points = samples, at;
  for (int i = 0; i < kInterpolationSteps; ++i) {
    limit.apply(points, at);
    for (std::size_t v = 0; v < points.size(); ++v) points[v] += samples[v] - at[v];
  }
  return points;
}

std::vector<SmoothnessPenalty> make_penalties(const relax::RelaxedMesh& relaxed,
                                              const Points& points, const FitOptions& options) {
  Points normals(points.size(), Eigen::Vector3d::Zero());
  for (const Triangle& t : relaxed.levels.back().triangles) {
    const Eigen::Vector3d normal = (points[t[1]] - points[t[0]]).cross(points[t[2]] - points[t[0]]);
    for (std::uint32_t v : t) normals[v] += normal;
  }
  std::vector<SmoothnessPenalty> penalties;
  SmoothnessWeights weights = options.smoothness;
  const auto levels = static_cast<int>(relaxed.levels.size()) - 1;
  const int last = std::max(levels - options.smooth_levels + 1, kCoarsestSmoothLevel);
  for (int l = levels; l > 0 && (l == levels || l >= last); --l) {
    penalties.emplace_back(relaxed.mesh.base, relaxed.levels[static_cast<std::size_t>(l - 1)],
                           normals, points, weights);
    weights.normal = 0;
    weights.tangential *= 4;  // as many times the area has a detail of the next coarser level
  }
  return penalties;
}

}  // namespace

FittedSurface fit_control_points(const domain::Domain& domain,
                                 const remesh::Parameterisation& laid_out,
                                 relax::RelaxedMesh relaxed, const FitOptions& options,
                                 const Progress& progress) {
  const relax::InputSurface input{domain.mesh, laid_out.charts.topology};
  const relax::SubdividedLevel& finest = relaxed.levels.back();
  const LimitOperator limit(relaxed.mesh.base, finest);
  const std::vector<SmoothnessPenalty> penalties =
      make_penalties(relaxed, relaxed.mesh.positions, options);
  Points points = interpolate(limit, std::move(relaxed.mesh.positions));
  std::vector<relax::SurfacePoint> foot_points = std::move(relaxed.points);
  NearestSamples nearest(input, finest, foot_points);
  std::vector<std::uint8_t> held(points.size(), 0);  // on curves and at corners
  for (int round = 0; round < options.rounds; ++round) {
    report_progress(progress, "fitting", static_cast<double>(round) / options.rounds);
    const FitTargets targets = [&] {
      Points at;
      limit.apply(points, at);
      return FitTargets{follow_feet(input, domain, finest, at, foot_points), nearest.follow(at),
                        domain.mesh.positions, options.tangential_share};
    }();
    NormalEquations(finest, limit, penalties, targets).solve(options.iterations, points);
    for (std::size_t v = 0; v < held.size(); ++v) held[v] = targets.feet[v].is_on_feature();
  }
  FittedSurface fitted;
  const InputOrientation orientation(input);
  draw_in_stray_faces(orientation, finest, limit, foot_points, points);
  fitted.turned_faces = turn_faces_back(orientation, finest, limit, held, foot_points, points);
  fitted.points = std::move(points);
  return fitted;
}

}  // namespace zerotree::fit
