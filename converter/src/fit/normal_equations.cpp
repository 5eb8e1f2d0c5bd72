#include "fit/normal_equations.h"

#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <numeric>

#include "relax/parallel_loop.h"

namespace zerotree::fit {
namespace {

// Keeps the preconditioner finite where neither a distance nor a penalty holds a vertex.
constexpr double kLeastDiagonal = 1e-3;
// Sums go over blocks of so many vertices, so that they do not depend on the threads.
constexpr std::size_t kBlock = 4096;

// The sum of weight[v] a[v] . b[v].
template <class Weight>
double weighted_dot(const Weight& weight, const Points& a, const Points& b) {
  std::vector<double> sums((a.size() + kBlock - 1) / kBlock, 0.0);
  relax::for_each_block(sums.size(), [&](std::size_t block) {
    const std::size_t end = std::min(a.size(), (block + 1) * kBlock);
    for (std::size_t v = block * kBlock; v < end; ++v) sums[block] += weight(v) * a[v].dot(b[v]);
  });
  return std::accumulate(sums.begin(), sums.end(), 0.0);
}

}  // namespace

NormalEquations::NormalEquations(const relax::SubdividedLevel& finest, const LimitOperator& limit,
                                 const std::vector<SmoothnessPenalty>& penalties,
                                 const FitTargets& targets)
    : finest_(finest),
      limit_(limit),
      penalties_(penalties),
      targets_(targets),
      along_(targets.samples.size()) {}

// A difference times the weights of its target: normal fully, tangential partly.
Eigen::Vector3d NormalEquations::weighted(const FootTarget& target,
                                          const Eigen::Vector3d& difference) const {
  const auto weight = static_cast<double>(target.weight);
  if (target.is_on_feature()) return weight * difference;
  const Eigen::Vector3d normal = target.normal.cast<double>();
  return weight * (normal.dot(difference) * normal + targets_.tangential_share * difference);
}

// The normal part of the limit point that is nearest to the input vertex.
double NormalEquations::along_normal(const InputSample& sample) const {
  const Triangle& t = finest_.triangles[sample.triangle];
  const Eigen::Vector3d w = sample.corner_weights.cast<double>();
  return sample.normal.cast<double>().dot(w[0] * at_[t[0]] + w[1] * at_[t[1]] + w[2] * at_[t[2]]);
}

void NormalEquations::pull_to_targets(Quantity quantity, const Points& points, Points& result) {
  const bool is_residual = quantity == Quantity::residual;
  const std::vector<InputSample>& samples = targets_.samples;
  limit_.apply(points, at_);
  relax::for_each_index(samples.size(), [&](std::size_t s) {
    const double at = along_normal(samples[s]);
    const double pull =
        is_residual ? samples[s].normal.cast<double>().dot(targets_.input[s]) - at : at;
    along_[s] = static_cast<float>(pull) * samples[s].weight;
  });
  relax::for_each_index(at_.size(), [&](std::size_t v) {
    const FootTarget& foot = targets_.feet[v];
    at_[v] = weighted(foot, is_residual ? (foot.position - at_[v]).eval() : at_[v]);
  });
  for (std::size_t s = 0; s < samples.size(); ++s) {
    const Triangle& t = finest_.triangles[samples[s].triangle];
    const Eigen::Vector3d pull = (along_[s] * samples[s].normal).cast<double>();
    for (int k = 0; k < 3; ++k)
      at_[t[static_cast<std::size_t>(k)]] +=
          static_cast<double>(samples[s].corner_weights[k]) * pull;
  }
  limit_.apply_transposed(at_, result);
}

void NormalEquations::evaluate(Quantity quantity, const Points& points, Points& result) {
  const double sign = quantity == Quantity::residual ? -1 : 1;
  tbb::parallel_invoke([&] { pull_to_targets(quantity, points, result); },
                       [&] {
                         penalty_.assign(points.size(), Eigen::Vector3d::Zero());
                         for (const SmoothnessPenalty& penalty : penalties_)
                           penalty.add_gradient(sign, points, penalty_);
                       });
  relax::for_each_index(result.size(), [&](std::size_t v) { result[v] += penalty_[v]; });
}

// One over an estimate of H's diagonal.
std::vector<float> NormalEquations::preconditioner() const {
  std::vector<double> diagonal(targets_.feet.size(), kLeastDiagonal);
  for (const SmoothnessPenalty& penalty : penalties_) penalty.add_diagonal(diagonal);
  std::vector<float> scale(diagonal.size());
  for (std::size_t v = 0; v < scale.size(); ++v)
    scale[v] = static_cast<float>(1 / (diagonal[v] + static_cast<double>(targets_.feet[v].weight)));
  return scale;
}

void NormalEquations::solve(int iterations, Points& points) {
  const std::vector<float> preconditioned = preconditioner();
  const auto scale = [&](std::size_t v) { return static_cast<double>(preconditioned[v]); };
  Points r, hd;
  Points d(points.size(), Eigen::Vector3d::Zero());
  evaluate(Quantity::residual, points, r);
  double last = 0;
  for (int i = 0; i < iterations; ++i) {
    const double rz = weighted_dot(scale, r, r);
    if (!(rz > 0)) return;
    const double beta = i == 0 ? 0 : rz / last;
    last = rz;
    relax::for_each_index(d.size(), [&](std::size_t v) { d[v] = scale(v) * r[v] + beta * d[v]; });
    evaluate(Quantity::product, d, hd);
    const double curvature = weighted_dot([](std::size_t) { return 1.0; }, d, hd);
    if (!(curvature > 0)) return;
    const double alpha = rz / curvature;
    relax::for_each_index(d.size(), [&](std::size_t v) {
      points[v] += alpha * d[v];
      r[v] -= alpha * hd[v];
    });
  }
}

}  // namespace zerotree::fit
