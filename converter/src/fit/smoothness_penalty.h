// What the finest details of a semi-regular mesh would be, as a quadratic penalty.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "bitstream/base_topology.h"
#include "fit/limit_operator.h"

namespace zerotree::fit {

/// What squared differences count, off the surface and along it.
struct SmoothnessWeights {
  double normal = 0;
  double tangential = 0;
};

/// The differences between the odd vertices of a level and their Butterfly prediction from the even
/// ones (Dyn, Levin, Gregory 1990), cubic along features and none next to corners. No stencil
/// crosses a feature: a wing beyond one is replaced by the parallelogram on this side. 88 bytes an
/// edge of the coarser level.
class SmoothnessPenalty {
 public:
  /// The odd vertices are those of the edges of `coarse`, a level of `base`. `normals` are the
  /// finest surface's, of any length; `positions` tell the tangents of curves.
  SmoothnessPenalty(const bitstream::BaseTopology& base, const relax::SubdividedLevel& coarse,
                    const Points& normals, const Points& positions,
                    const SmoothnessWeights& weights);

  /// Adds `sign` x D^T W D points to `gradient`, where D points are the differences and W their
  /// weights. `Vector` as LimitOperator has it.
  template <class Vector>
  void add_gradient(double sign, const std::vector<Vector>& points,
                    std::vector<Vector>& gradient) const;
  /// Adds a bound of the diagonal of D^T W D at each vertex: what a preconditioner wants to know.
  void add_diagonal(std::vector<double>& diagonal) const;

 private:
  static constexpr std::size_t kMost = 8;
  struct Stencil {
    std::array<std::uint32_t, kMost> vertices;
    std::array<float, kMost> weights;
    std::uint32_t count = 0;
    // Of unit length: the surface's normal or the curve's tangent.
    Eigen::Vector3f axis = Eigen::Vector3f::Zero();
    float along_axis = 0, across_axis = 0;
  };
  void set_axes(const relax::SubdividedLevel& coarse, const Points& normals,
                const Points& positions, const SmoothnessWeights& weights);

  std::uint32_t first_odd_;
  std::vector<Stencil> stencils_;  // of each edge; empty: no penalty
};

}  // namespace zerotree::fit
