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
/// penalties of its details, all squared. Refers to its parts.
class NormalEquations {
 public:
  NormalEquations(const relax::SubdividedLevel& finest, const LimitOperator& limit,
                  const std::vector<SmoothnessPenalty>& penalties, const FitTargets& targets)
      : finest_(finest), limit_(limit), penalties_(penalties), targets_(targets) {}

  /// Preconditioned conjugate gradients (Hestenes, Stiefel 1952), `iterations` of them, from
  /// `points`. On two threads; the result does not depend on their number. Takes 76 bytes a control
  /// point.
  void solve(int iterations, Points& points) const;

 private:
  // Limit points and what pulls at them, by what they pull at the control points, and by how much
  // the samples pull.
  template <class Vector>
  struct Scratch {
    std::vector<Vector> limit, penalty;
    std::vector<float> along;
  };
  enum class Quantity { product, residual };  // H x or b - H x
  template <Quantity quantity, class Vector>
  void evaluate(const std::vector<Vector>& points, std::vector<Vector>& result,
                Scratch<Vector>& scratch) const;
  template <Quantity quantity, class Vector>
  void pull_to_targets(const std::vector<Vector>& points, std::vector<Vector>& result,
                       Scratch<Vector>& scratch) const;
  template <class Vector>
  Vector weighted(const FootTarget& target, const Vector& difference) const;
  std::vector<float> preconditioner() const;
  Differences residual(const Points& points) const;

  const relax::SubdividedLevel& finest_;
  const LimitOperator& limit_;
  const std::vector<SmoothnessPenalty>& penalties_;
  const FitTargets& targets_;
};

}  // namespace zerotree::fit
