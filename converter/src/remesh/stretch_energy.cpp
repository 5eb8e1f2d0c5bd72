#include "remesh/stretch_energy.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

namespace zerotree::remesh {
namespace {

// Degenerate input triangles count as this share of an equilateral one, so that they too keep
// some room in the domain.
constexpr double kRegularShare = 1e-3;
// A step may shrink a triangle to this share of its area.
constexpr double kKeptArea = 0.1;
constexpr int kMaxHalvings = 12;

// The largest share of the step from `p` to `q` that leaves each triangle the kept area.
double allowed_share(const Ring& ring, const Eigen::Vector2d& p, const Eigen::Vector2d& q) {
  double share = 1;
  for (std::size_t i = 0; i < ring.edge_count(); ++i) {
    const Eigen::Vector2d &a = ring.points[i], &b = ring.points[ring.after(i)];
    const double at_p = doubled_area(p, a, b), at_q = doubled_area(q, a, b);
    if (at_q < kKeptArea * at_p) share = std::min(share, (1 - kKeptArea) * at_p / (at_p - at_q));
  }
  return share;
}

// The first point on the way from `p` to `q`, halving the rest, that has less energy; else `p`.
Eigen::Vector2d search_line(const StretchEnergy& energy, const Ring& ring, const Eigen::Vector2d& p,
                            double at_p, const Eigen::Vector2d& q) {
  Eigen::Vector2d step = (q - p) * allowed_share(ring, p, q);
  for (int i = 0; i < kMaxHalvings; ++i, step /= 2)
    if (energy.energy(p + step) < at_p) return p + step;
  return p;
}

}  // namespace

void StretchEnergy::prepare(const Ring& ring, const Eigen::Vector3d& position) {
  ring_ = &ring;
  terms_.clear();
  for (std::size_t i = 0; i < ring.edge_count(); ++i) {
    const Eigen::Vector3d &a = ring.positions[i], &b = ring.positions[ring.after(i)];
    const double area = (a - position).cross(b - position).norm() / 2;
    std::array<double, 3> lengths{(b - a).squaredNorm(), (b - position).squaredNorm(),
                                  (a - position).squaredNorm()};
    const double regular = kRegularShare * (lengths[0] + lengths[1] + lengths[2]) / 3 + 1e-300;
    for (double& length : lengths) length += regular;
    terms_.push_back({area + regular, lengths});
  }
}

double StretchEnergy::energy(const Eigen::Vector2d& p) const {
  double sum = 0;
  for (std::size_t i = 0; i < terms_.size(); ++i) {
    const Eigen::Vector2d a = ring_->points[i] - p, b = ring_->points[ring_->after(i)] - p;
    const double area = a.x() * b.y() - a.y() * b.x();
    if (!(area > 0)) return std::numeric_limits<double>::infinity();
    const auto& l = terms_[i].squared_lengths;
    const double ab = a.dot(b);
    const double n = l[0] * ab + l[1] * (a.squaredNorm() - ab) + l[2] * (b.squaredNorm() - ab);
    sum += terms_[i].weight * n / (area * area);
  }
  return sum;
}

StretchEnergy::Value StretchEnergy::evaluate(const Eigen::Vector2d& p) const {
  Value value;
  for (std::size_t i = 0; i < terms_.size(); ++i) {
    const Eigen::Vector2d a = ring_->points[i] - p, b = ring_->points[ring_->after(i)] - p;
    const auto& l = terms_[i].squared_lengths;
    const double per_area = 1 / (a.x() * b.y() - a.y() * b.x()), ab = a.dot(b);
    const double n = l[0] * ab + l[1] * (a.squaredNorm() - ab) + l[2] * (b.squaredNorm() - ab);
    // Derivatives by p: a and b move by -p; the area's gradient is the edge turned by a right
    // angle.
    const Eigen::Vector2d s = Eigen::Vector2d(a.y() - b.y(), b.x() - a.x()) * per_area;
    const Eigen::Vector2d g = -l[0] * (a + b) + (l[1] - l[2]) * (b - a);
    const double f = terms_[i].weight * per_area * per_area;
    value.energy += f * n;
    value.gradient += f * (g - 2 * n * s);
    // With s and g the gradients of the area, as a share of it, and of N.
    const double xx = 2 * l[0] - 4 * g.x() * s.x() + 6 * n * s.x() * s.x();
    const double yy = 2 * l[0] - 4 * g.y() * s.y() + 6 * n * s.y() * s.y();
    const double xy = -2 * (g.x() * s.y() + g.y() * s.x()) + 6 * n * s.x() * s.y();
    value.hessian(0, 0) += f * xx;
    value.hessian(1, 1) += f * yy;
    value.hessian(0, 1) += f * xy;
  }
  value.hessian(1, 0) = value.hessian(0, 1);
  return value;
}

Eigen::Vector2d minimise_in_plane(const StretchEnergy& energy, const Ring& ring, Eigen::Vector2d p,
                                  int steps) {
  for (int i = 0; i < steps; ++i) {
    const StretchEnergy::Value value = energy.evaluate(p);
    const double trace = value.hessian.trace(), determinant = value.hessian.determinant();
    // Where the energy is not convex, go downhill by the scale of its curvature.
    const Eigen::Vector2d step = determinant > 1e-6 * trace * trace && trace > 0
                                     ? (value.hessian.inverse() * value.gradient).eval()
                                     : (value.gradient / std::max(std::abs(trace), 1e-300)).eval();
    const Eigen::Vector2d next = search_line(energy, ring, p, value.energy, p - step);
    if (next == p) break;
    p = next;
  }
  return p;
}

double minimise_on_line(const StretchEnergy& energy, const Ring& ring, const Eigen::Vector2d& a,
                        const Eigen::Vector2d& b, double s, int steps) {
  const Eigen::Vector2d direction = b - a;
  for (int i = 0; i < steps; ++i) {
    const Eigen::Vector2d p = a + s * direction;
    const StretchEnergy::Value value = energy.evaluate(p);
    const double slope = value.gradient.dot(direction);
    const double curvature = std::abs(direction.dot(value.hessian * direction));
    if (!(curvature > 0)) break;
    double step = -slope / curvature;
    step *= allowed_share(ring, p, p + step * direction);
    double next = s;
    for (int j = 0; j < kMaxHalvings && next == s; ++j, step /= 2)
      if (energy.energy(p + step * direction) < value.energy) next = s + step;
    if (next == s) break;
    s = next;
  }
  return s;
}

}  // namespace zerotree::remesh
