#include "fit/surface_fit.h"

#include <Eigen/Geometry>

#include "fit/fit_targets.h"
#include "fit/turned_faces.h"

namespace zerotree::fit {
namespace {

// Steps p <- p + (s - limit(p)) that bring the limit surface near the samples: smooth waves are
// reproduced, the roughest noise is amplified by at most 4 (1 - (3/4)^4).
constexpr int kInterpolationSteps = 3;
// Keeps the preconditioner finite where neither a distance nor a penalty holds a vertex.
constexpr double kLeastDiagonal = 1e-3;

double dot(const Points& a, const Points& b) {
  double sum = 0;
  for (std::size_t v = 0; v < a.size(); ++v) sum += a[v].dot(b[v]);
  return sum;
}

Points interpolate(const LimitOperator& limit, const Points& samples) {
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
  for (int l = levels; l > 0 && l > levels - options.smooth_levels; --l) {
    penalties.emplace_back(relaxed.mesh.base, relaxed.levels[static_cast<std::size_t>(l - 1)],
                           normals, points, weights);
    weights.normal = 0;
  }
  return penalties;
}

// The normal equations of one round: fixed targets, a quadratic function of the control points.
class NormalEquations {
 public:
  NormalEquations(const relax::SubdividedLevel& finest, const Points& input,
                  const LimitOperator& limit, const std::vector<SmoothnessPenalty>& penalties,
                  const FitTargets& targets, double tangential_share)
      : finest_(finest),
        input_(input),
        limit_(limit),
        penalties_(penalties),
        targets_(targets),
        tangential_share_(tangential_share) {}

  // result = H direction.
  void apply(const Points& direction, Points& result) {
    limit_.apply(direction, at_);
    pull_.resize(at_.size());
    for (std::size_t v = 0; v < at_.size(); ++v) pull_[v] = weighted(targets_.feet[v], at_[v]);
    for (const InputSample& sample : targets_.samples) add_pull(sample, along_normal(sample));
    limit_.apply_transposed(pull_, result);
    for (const SmoothnessPenalty& penalty : penalties_) penalty.add_gradient(1, direction, result);
  }

  // The negative gradient at `points`.
  Points residual(const Points& points) {
    limit_.apply(points, at_);
    pull_.resize(at_.size());
    for (std::size_t v = 0; v < at_.size(); ++v)
      pull_[v] = weighted(targets_.feet[v], targets_.feet[v].position - at_[v]);
    for (std::size_t s = 0; s < targets_.samples.size(); ++s) {
      const InputSample& sample = targets_.samples[s];
      add_pull(sample, sample.normal.cast<double>().dot(input_[s]) - along_normal(sample));
    }
    Points result;
    limit_.apply_transposed(pull_, result);
    for (const SmoothnessPenalty& penalty : penalties_) penalty.add_gradient(-1, points, result);
    return result;
  }

  // One over an estimate of H's diagonal.
  std::vector<double> preconditioner() const {
    std::vector<double> scale(targets_.feet.size(), kLeastDiagonal);
    for (const SmoothnessPenalty& penalty : penalties_) penalty.add_diagonal(scale);
    for (std::size_t v = 0; v < scale.size(); ++v)
      scale[v] = 1 / (scale[v] + targets_.feet[v].weight);
    return scale;
  }

 private:
  // A difference times the weights of its target: normal fully, tangential partly.
  Eigen::Vector3d weighted(const FootTarget& target, const Eigen::Vector3d& difference) const {
    if (target.normal.isZero(0)) return target.weight * difference;
    return target.weight *
           (target.normal.dot(difference) * target.normal + tangential_share_ * difference);
  }

  // The normal part of the limit point that is nearest to the input vertex.
  double along_normal(const InputSample& sample) const {
    const Triangle& t = finest_.triangles[sample.triangle];
    const Eigen::Vector3d w = sample.corner_weights.cast<double>();
    return sample.normal.cast<double>().dot(w[0] * at_[t[0]] + w[1] * at_[t[1]] + w[2] * at_[t[2]]);
  }

  void add_pull(const InputSample& sample, double along) {
    const Triangle& t = finest_.triangles[sample.triangle];
    const Eigen::Vector3d pull =
        static_cast<double>(sample.weight) * along * sample.normal.cast<double>();
    for (int k = 0; k < 3; ++k)
      pull_[t[static_cast<std::size_t>(k)]] += static_cast<double>(sample.corner_weights[k]) * pull;
  }

  const relax::SubdividedLevel& finest_;
  const Points& input_;
  const LimitOperator& limit_;
  const std::vector<SmoothnessPenalty>& penalties_;
  const FitTargets& targets_;
  double tangential_share_;
  Points at_, pull_;
};

// Preconditioned conjugate gradients (Hestenes, Stiefel 1952), a fixed number of them.
void solve(NormalEquations& equations, int iterations, Points& points) {
  const std::vector<double> scale = equations.preconditioner();
  Points r = equations.residual(points), z(r.size()), hd;
  Points d(r.size(), Eigen::Vector3d::Zero());
  double last = 0;
  for (int i = 0; i < iterations; ++i) {
    for (std::size_t v = 0; v < r.size(); ++v) z[v] = scale[v] * r[v];
    const double rz = dot(r, z);
    if (!(rz > 0)) return;
    const double beta = i == 0 ? 0 : rz / last;
    last = rz;
    for (std::size_t v = 0; v < r.size(); ++v) d[v] = z[v] + beta * d[v];
    equations.apply(d, hd);
    const double curvature = dot(d, hd);
    if (!(curvature > 0)) return;
    const double alpha = rz / curvature;
    for (std::size_t v = 0; v < r.size(); ++v) {
      points[v] += alpha * d[v];
      r[v] -= alpha * hd[v];
    }
  }
}

}  // namespace

FittedSurface fit_control_points(const domain::Domain& domain,
                                 const remesh::Parameterisation& laid_out,
                                 const relax::RelaxedMesh& relaxed, const FitOptions& options,
                                 const Progress& progress) {
  const relax::InputSurface input{domain.mesh, laid_out.charts.topology};
  const relax::SubdividedLevel& finest = relaxed.levels.back();
  const LimitOperator limit(relaxed.mesh.base, finest);
  const std::vector<SmoothnessPenalty> penalties =
      make_penalties(relaxed, relaxed.mesh.positions, options);
  Points points = interpolate(limit, relaxed.mesh.positions), at;
  std::vector<relax::SurfacePoint> foot_points = relaxed.points;
  std::vector<std::uint8_t> held(points.size(), 0);  // on curves and at corners
  for (int round = 0; round < options.rounds; ++round) {
    report_progress(progress, "fitting", static_cast<double>(round) / options.rounds);
    limit.apply(points, at);
    const FitTargets targets = find_targets(input, domain, finest, at, foot_points);
    NormalEquations equations(finest, domain.mesh.positions, limit, penalties, targets,
                              options.tangential_share);
    solve(equations, options.iterations, points);
    for (std::size_t v = 0; v < held.size(); ++v) held[v] = targets.feet[v].normal.isZero(0);
  }
  FittedSurface fitted;
  fitted.turned_faces = turn_faces_back(input, finest, limit, held, foot_points, points);
  fitted.points = std::move(points);
  return fitted;
}

}  // namespace zerotree::fit
