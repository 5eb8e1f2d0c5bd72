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

// The sum of scale[v] a[v] . b[v], or without scales.
double dot(const Differences& a, const Differences& b, const std::vector<float>* scale = nullptr) {
  std::vector<double> sums((a.size() + kBlock - 1) / kBlock, 0.0);
  relax::for_each_block(sums.size(), [&](std::size_t block) {
    const std::size_t end = std::min(a.size(), (block + 1) * kBlock);
    for (std::size_t v = block * kBlock; v < end; ++v)
      sums[block] += a[v].cast<double>().dot(b[v].cast<double>()) *
                     static_cast<double>(scale ? (*scale)[v] : 1.0f);
  });
  return std::accumulate(sums.begin(), sums.end(), 0.0);
}

}  // namespace

// A difference times the weights of its target: normal fully, tangential partly.
template <class Vector>
Vector NormalEquations::weighted(const FootTarget& target, const Vector& difference) const {
  using Scalar = typename Vector::Scalar;
  const Scalar weight = target.weight;
  if (target.is_on_feature()) return weight * difference;
  const Vector normal = target.normal.template cast<Scalar>();
  return weight * (normal.dot(difference) * normal +
                   static_cast<Scalar>(targets_.tangential_share) * difference);
}

template <NormalEquations::Quantity quantity, class Vector>
void NormalEquations::pull_to_targets(const std::vector<Vector>& points,
                                      std::vector<Vector>& result, Scratch<Vector>& scratch) const {
  using Scalar = typename Vector::Scalar;
  constexpr bool is_residual = quantity == Quantity::residual;
  const std::vector<InputSample>& samples = targets_.samples;
  std::vector<Vector>& limit = scratch.limit;
  limit_.apply(points, limit);
  scratch.along.resize(samples.size());
  relax::for_each_index(samples.size(), [&](std::size_t s) {
    const InputSample& sample = samples[s];
    const Triangle& t = finest_.triangles[sample.triangle];
    const Vector w = sample.corner_weights.template cast<Scalar>();
    Vector pull = w[0] * limit[t[0]] + w[1] * limit[t[1]] + w[2] * limit[t[2]];
    if constexpr (is_residual) pull = targets_.input[s] - pull;
    const Vector normal = sample.normal.template cast<Scalar>();
    scratch.along[s] = static_cast<float>(normal.dot(pull)) * sample.weight;
  });
  relax::for_each_index(limit.size(), [&](std::size_t v) {
    const FootTarget& foot = targets_.feet[v];
    if constexpr (is_residual) limit[v] = foot.position - limit[v];
    limit[v] = weighted(foot, limit[v]);
  });
  for (std::size_t s = 0; s < samples.size(); ++s) {
    const Triangle& t = finest_.triangles[samples[s].triangle];
    const Eigen::Vector3f pull = scratch.along[s] * samples[s].normal;
    for (int k = 0; k < 3; ++k)
      limit[t[static_cast<std::size_t>(k)]] +=
          (samples[s].corner_weights[k] * pull).template cast<Scalar>();
  }
  limit_.apply_transposed(limit, result);
}

template <NormalEquations::Quantity quantity, class Vector>
void NormalEquations::evaluate(const std::vector<Vector>& points, std::vector<Vector>& result,
                               Scratch<Vector>& scratch) const {
  tbb::parallel_invoke([&] { pull_to_targets<quantity>(points, result, scratch); },
                       [&] {
                         scratch.penalty.assign(points.size(), Vector::Zero());
                         for (const SmoothnessPenalty& penalty : penalties_)
                           penalty.add_gradient(quantity == Quantity::residual ? -1 : 1, points,
                                                scratch.penalty);
                       });
  relax::for_each_index(result.size(), [&](std::size_t v) { result[v] += scratch.penalty[v]; });
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

// In doubles, as it is a small difference of large numbers.
Differences NormalEquations::residual(const Points& points) const {
  Points exact;
  Scratch<Eigen::Vector3d> scratch;
  evaluate<Quantity::residual>(points, exact, scratch);
  Differences rounded(exact.size());
  for (std::size_t v = 0; v < exact.size(); ++v) rounded[v] = exact[v].cast<float>();
  return rounded;
}

void NormalEquations::solve(int iterations, Points& points) const {
  Differences r = residual(points), d(r.size(), Eigen::Vector3f::Zero()), hd;
  const std::vector<float> scale = preconditioner();
  Scratch<Eigen::Vector3f> scratch;
  double last = 0;
  for (int i = 0; i < iterations; ++i) {
    const double rz = dot(r, r, &scale);
    if (!(rz > 0)) return;
    const auto beta = static_cast<float>(i == 0 ? 0 : rz / last);
    last = rz;
    relax::for_each_index(d.size(), [&](std::size_t v) { d[v] = scale[v] * r[v] + beta * d[v]; });
    evaluate<Quantity::product>(d, hd, scratch);
    const double curvature = dot(d, hd);
    if (!(curvature > 0)) return;
    const auto alpha = static_cast<float>(rz / curvature);
    relax::for_each_index(d.size(), [&](std::size_t v) {
      points[v] += (alpha * d[v]).cast<double>();
      r[v] -= alpha * hd[v];
    });
  }
}

}  // namespace zerotree::fit
