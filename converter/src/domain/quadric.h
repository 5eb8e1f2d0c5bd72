// Garland and Heckbert's quadric error metric.
#pragma once

#include <Eigen/Core>

namespace zerotree::domain {

/// Sum of weighted squared distances from planes, as d^T A d + 2 b^T d + c with a symmetric A and d
/// the way from the place of the vertex that has the quadric: b and c stay small, so that floats
/// hold them.
struct Quadric {
  float xx = 0, yy = 0, zz = 0, xy = 0, yz = 0, zx = 0;  ///< of A
  Eigen::Vector3f b = Eigen::Vector3f::Zero();
  float c = 0;

  /// Adds the plane through the vertex with the unit `normal`.
  void add_plane(const Eigen::Vector3d& normal, double weight) {
    const Eigen::Vector3d scaled = weight * normal;
    xx += static_cast<float>(scaled.x() * normal.x());
    yy += static_cast<float>(scaled.y() * normal.y());
    zz += static_cast<float>(scaled.z() * normal.z());
    xy += static_cast<float>(scaled.x() * normal.y());
    yz += static_cast<float>(scaled.y() * normal.z());
    zx += static_cast<float>(scaled.z() * normal.x());
  }
  /// Adds the quadric of another vertex, `offset` away from this one as seen from the other.
  void add(const Quadric& other, const Eigen::Vector3d& offset) {
    c += static_cast<float>(other.at(offset));
    b += other.b + other.times(offset).cast<float>();
    xx += other.xx;
    yy += other.yy;
    zz += other.zz;
    xy += other.xy;
    yz += other.yz;
    zx += other.zx;
  }
  /// The sum of the planes' weights.
  double weight() const { return double{xx} + yy + zz; }
  /// The value `d` away from the vertex; never negative, which rounding could otherwise make it.
  double at(const Eigen::Vector3d& d) const {
    const double value = d.dot(times(d) + 2 * b.cast<double>()) + c;
    return value > 0 ? value : 0;
  }

 private:
  // A d.
  Eigen::Vector3d times(const Eigen::Vector3d& d) const {
    return {xx * d.x() + xy * d.y() + zx * d.z(), xy * d.x() + yy * d.y() + yz * d.z(),
            zx * d.x() + yz * d.y() + zz * d.z()};
  }
};

}  // namespace zerotree::domain
