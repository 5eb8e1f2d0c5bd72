// Garland and Heckbert's quadric error metric.
#pragma once

#include <Eigen/Core>

namespace zerotree::domain {

/// Sum of weighted squared distances from planes, as p^T A p + 2 b^T p + c with a symmetric A.
struct Quadric {
  double xx = 0, yy = 0, zz = 0, xy = 0, yz = 0, zx = 0;  ///< of A
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  double c = 0;

  /// Adds the plane through `point` with the unit `normal`.
  void add_plane(const Eigen::Vector3d& normal, const Eigen::Vector3d& point, double weight) {
    const double d = -normal.dot(point);
    const Eigen::Vector3d scaled = weight * normal;
    xx += scaled.x() * normal.x();
    yy += scaled.y() * normal.y();
    zz += scaled.z() * normal.z();
    xy += scaled.x() * normal.y();
    yz += scaled.y() * normal.z();
    zx += scaled.z() * normal.x();
    b += d * scaled;
    c += weight * d * d;
  }
  void add(const Quadric& other) {
    xx += other.xx;
    yy += other.yy;
    zz += other.zz;
    xy += other.xy;
    yz += other.yz;
    zx += other.zx;
    b += other.b;
    c += other.c;
  }
  /// The sum of the planes' weights.
  double weight() const { return xx + yy + zz; }
  /// Never negative, which rounding could otherwise make it.
  double at(const Eigen::Vector3d& p) const {
    const double value = xx * p.x() * p.x() + yy * p.y() * p.y() + zz * p.z() * p.z() +
                         2 * (xy * p.x() * p.y() + yz * p.y() * p.z() + zx * p.z() * p.x()) +
                         2 * b.dot(p) + c;
    return value > 0 ? value : 0;
  }
};

}  // namespace zerotree::domain
