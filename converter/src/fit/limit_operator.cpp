#include "fit/limit_operator.h"

#include <cmath>
#include <numbers>

namespace zerotree::fit {
namespace {

// The limit weight of one neighbour of a smooth vertex (Loop 1987).
double limit_weight(std::uint32_t valence) {
  const double n = valence;
  const double c = 0.375 + std::cos(2 * std::numbers::pi / n) / 4;
  const double beta = (0.625 - c * c) / n;
  return 1 / (0.375 / beta + n);
}

}  // namespace

LimitOperator::LimitOperator(const bitstream::BaseTopology& base,
                             const relax::SubdividedLevel& level)
    : level_(level),
      own_(level.vertex_count, 1.0f),
      neighbour_(level.vertex_count, 0.0f),
      feature_neighbour_(level.vertex_count, 0.0f) {
  std::vector<std::uint32_t> valences(level.vertex_count, 0);
  std::vector<std::uint8_t> features(level.vertex_count, 0);
  for (std::size_t e = 0; e < level.edges.size(); ++e)
    for (std::uint32_t v : level.edges[e]) {
      ++valences[v];
      features[v] = static_cast<std::uint8_t>(std::min(features[v] + level.is_feature[e], 3));
    }
  for (std::uint32_t v : base.corner_vertices) features[v] = 3;
  for (std::size_t v = 0; v < own_.size(); ++v) {
    if (valences[v] == 2) features[v] = 3;  // a corner of the boundary with one face
    if (features[v] < 2) {
      const double weight = valences[v] == 6 ? 1.0 / 12 : limit_weight(valences[v]);
      neighbour_[v] = feature_neighbour_[v] = static_cast<float>(weight);
      own_[v] = static_cast<float>(1 - weight * valences[v]);
    } else if (features[v] == 2) {
      own_[v] = 2.0f / 3;
      feature_neighbour_[v] = 1.0f / 6;
    }
  }
}

template <class Vector>
void LimitOperator::apply(const std::vector<Vector>& points, std::vector<Vector>& limit) const {
  using Scalar = typename Vector::Scalar;
  limit.resize(points.size());
  for (std::size_t v = 0; v < points.size(); ++v) limit[v] = Scalar{own_[v]} * points[v];
  for (std::size_t e = 0; e < level_.edges.size(); ++e) {
    const auto [a, b] = level_.edges[e];
    const std::vector<float>& weight = level_.is_feature[e] ? feature_neighbour_ : neighbour_;
    limit[a] += Scalar{weight[a]} * points[b];
    limit[b] += Scalar{weight[b]} * points[a];
  }
}

template <class Vector>
void LimitOperator::apply_transposed(const std::vector<Vector>& values,
                                     std::vector<Vector>& result) const {
  using Scalar = typename Vector::Scalar;
  result.resize(values.size());
  for (std::size_t v = 0; v < values.size(); ++v) result[v] = Scalar{own_[v]} * values[v];
  for (std::size_t e = 0; e < level_.edges.size(); ++e) {
    const auto [a, b] = level_.edges[e];
    const std::vector<float>& weight = level_.is_feature[e] ? feature_neighbour_ : neighbour_;
    result[b] += Scalar{weight[a]} * values[a];
    result[a] += Scalar{weight[b]} * values[b];
  }
}

template void LimitOperator::apply(const Points&, Points&) const;
template void LimitOperator::apply(const Differences&, Differences&) const;
template void LimitOperator::apply_transposed(const Points&, Points&) const;
template void LimitOperator::apply_transposed(const Differences&, Differences&) const;

}  // namespace zerotree::fit
