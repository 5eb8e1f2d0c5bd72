// The least squares problem of one round of the fit.
#pragma once

#include <vector>

#include "fit/foot_targets.h"
#include "fit/limit_operator.h"
#include "fit/nearest_samples.h"
#include "fit/smoothness_penalty.h"

namespace zerotree::fit {

/// What the limit surface shall meet while the targets stand still.
struct FitTargets {
  std::vector<FootTarget> feet;               ///< of the limit vertices
  const std::vector<InputSample>& samples;    ///< of the input's vertices ...
  const std::vector<Eigen::Vector3d>& input;  ///< ... which lie here
  /// What a tangential distance counts as a share of a normal one.
  double tangential_share;
};

/// H x = b for the control points x: the distances of the limit surface from its targets and the
/// penalties of its details, all squared. Refers to its parts; 48 bytes a control point.
class NormalEquations {
 public:
  NormalEquations(const relax::SubdividedLevel& finest, const LimitOperator& limit,
                  const std::vector<SmoothnessPenalty>& penalties, const FitTargets& targets);

  /// Preconditioned conjugate gradients (Hestenes, Stiefel 1952), `iterations` of them, from
  /// `points`. On two threads; the result does not depend on their number.
  void solve(int iterations, Points& points);

 private:
  enum class Quantity { product, residual };  // H x or b - H x
  void evaluate(Quantity quantity, const Points& points, Points& result);
  void pull_to_targets(Quantity quantity, const Points& points, Points& result);
  Eigen::Vector3d weighted(const FootTarget& target, const Eigen::Vector3d& difference) const;
  double along_normal(const InputSample& sample) const;
  std::vector<float> preconditioner() const;

  const relax::SubdividedLevel& finest_;
  const LimitOperator& limit_;
  const std::vector<SmoothnessPenalty>& penalties_;
  const FitTargets& targets_;
  Points at_;       // limit points, then what pulls at them
  Points penalty_;  // what pulls at the control points
  std::vector<float> along_;
};

}  // namespace zerotree::fit
