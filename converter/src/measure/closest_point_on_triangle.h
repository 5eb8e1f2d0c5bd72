// The point of a triangle that is nearest to a given point.
#pragma once

#include <Eigen/Core>

namespace zerotree::measure {

/// Weights of the corners, not negative and of sum 1, of the point of triangle (a, b, c) nearest to
/// `p` (Ericson, Real-Time Collision Detection, 5.1.5). They are exactly 0 for corners that have no
/// part in it.
Eigen::Vector3d closest_weights_on_triangle(const Eigen::Vector3d& p, const Eigen::Vector3d& a,
                                            const Eigen::Vector3d& b, const Eigen::Vector3d& c);

/// That point itself. It always lies on the triangle, however thin, so its distance to `p` is never
/// too small by more than rounding.
Eigen::Vector3d closest_point_on_triangle(const Eigen::Vector3d& p, const Eigen::Vector3d& a,
                                          const Eigen::Vector3d& b, const Eigen::Vector3d& c);

}  // namespace zerotree::measure
