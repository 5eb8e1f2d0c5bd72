// Limit positions of Loop control points, as an operator that can also be applied transposed.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "bitstream/base_topology.h"
#include "relax/subdivided_levels.h"

namespace zerotree::fit {

using Points = std::vector<Eigen::Vector3d>;
/// What is small, so that floats do: steps and gradients.
using Differences = std::vector<Eigen::Vector3f>;

/// The limit of Loop's scheme at the vertices of one level: the rules that surface::limit_stencils
/// has from OpenSubdiv, at 16 bytes a vertex instead of 40. Refers to the level.
class LimitOperator {
 public:
  /// `level` is one of the levels of `base`, not the base itself.
  LimitOperator(const bitstream::BaseTopology& base, const relax::SubdividedLevel& level);

  /// limit = A points. O(edges). `Vector` is Eigen::Vector3d or, for differences, Eigen::Vector3f.
  template <class Vector>
  void apply(const std::vector<Vector>& points, std::vector<Vector>& limit) const;
  /// result = A^T values.
  template <class Vector>
  void apply_transposed(const std::vector<Vector>& values, std::vector<Vector>& result) const;

  /// The weight of a vertex's own control point in its limit position.
  double own_weight(std::size_t v) const { return static_cast<double>(own_[v]); }
  /// The weight of each neighbour's; of those along its feature if it is on one.
  double neighbour_weight(std::size_t v) const {
    return static_cast<double>(feature_neighbour_[v]);
  }

 private:
  const relax::SubdividedLevel& level_;
  // Weight of the vertex itself, of each neighbour, and of each neighbour along a feature.
  std::vector<float> own_, neighbour_, feature_neighbour_;
};

}  // namespace zerotree::fit
