// Garland and Heckbert's quadric error metric.
#pragma once

#include <Eigen/Core>

namespace zerotree::domain {

/// Sum of weighted squared distances from planes, as p^T A p + 2 b^T p + c.
struct Quadric {
  Eigen::Matrix3d a = Eigen::Matrix3d::Zero();
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  double c = 0;

  /// Adds the plane through `point` with the unit `normal`.
  void add_plane(const Eigen::Vector3d& normal, const Eigen::Vector3d& point, double weight) {
    const double d = -normal.dot(point);
    a += weight * normal * normal.transpose();
    b += weight * d * normal;
    c += weight * d * d;
  }
  void add(const Quadric& other) {
    a += other.a;
    b += other.b;
    c += other.c;
  }
  /// Never negative, which rounding could otherwise make it.
  double at(const Eigen::Vector3d& p) const {
    const double value = p.dot(a * p) + 2 * b.dot(p) + c;
    return value > 0 ? value : 0;
  }
};

}  // namespace zerotree::domain
