// The energy that spreads the surface over the domain (Sander et al. 2001, L2 stretch).
#pragma once

#include "remesh/ring_kernel.h"

namespace zerotree::remesh {

/// Sum over the triangles between a moving vertex and its ring of
///   area on the mesh / area in the domain x Dirichlet energy of the map from domain to mesh,
/// a rational function of the vertex's place p: c N(p) / A(p)^2, N quadratic, A linear.
class StretchEnergy {
 public:
  /// Prepares for the vertex that is at `position` on the mesh. The ring must outlive this.
  void prepare(const Ring& ring, const Eigen::Vector3d& position);

  struct Value {
    double energy = 0;
    Eigen::Vector2d gradient = Eigen::Vector2d::Zero();
    Eigen::Matrix2d hessian = Eigen::Matrix2d::Zero();
  };
  /// Infinite energy if a triangle is not positive at `p`.
  double energy(const Eigen::Vector2d& p) const;
  Value evaluate(const Eigen::Vector2d& p) const;

 private:
  struct Term {
    double weight;
    std::array<double, 3> squared_lengths;  // opposite the vertex, ring point i, ring point i + 1
  };
  const Ring* ring_ = nullptr;
  std::vector<Term> terms_;
};

/// Up to `steps` Newton steps with line search from `p`, which must lie in the kernel. Each step
/// lowers the energy and leaves every triangle at least a tenth of its area.
Eigen::Vector2d minimise_in_plane(const StretchEnergy& energy, const Ring& ring, Eigen::Vector2d p,
                                  int steps);

/// The same along a + s (b - a), for s only.
double minimise_on_line(const StretchEnergy& energy, const Ring& ring, const Eigen::Vector2d& a,
                        const Eigen::Vector2d& b, double s, int steps);

}  // namespace zerotree::remesh
