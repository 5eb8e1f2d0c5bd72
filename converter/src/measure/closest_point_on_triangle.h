// The point of a triangle that is nearest to a given point.
#pragma once

#include <Eigen/Core>

namespace zerotree::measure {

/// The point of triangle (a, b, c) nearest to `p` (Ericson, Real-Time Collision Detection, 5.1.5).
/// The answer always lies on the triangle, however thin, so its distance to `p` is never too small
/// by more than rounding.
Eigen::Vector3d closest_point_on_triangle(const Eigen::Vector3d& p, const Eigen::Vector3d& a,
                                          const Eigen::Vector3d& b, const Eigen::Vector3d& c);

}  // namespace zerotree::measure
