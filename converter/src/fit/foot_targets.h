// What the input wants of the limit vertices: planes, curves and places to go through.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "domain/domain.h"
#include "fit/limit_operator.h"
#include "relax/subdivided_levels.h"
#include "relax/surface_walk.h"

namespace zerotree::fit {

/// Of a limit vertex: its foot on the input.
struct FootTarget {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  /// Unit normal of the input there; zero on feature curves and at corners, where each direction
  /// counts.
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();
  float weight = 0;

  bool is_on_feature() const { return normal.isZero(0); }
};

/// The feet of the vertices of the limit mesh `limit`, `finest`. `foot_points` are those known so
/// far: they are led on by short walks along the input. Weights are areas and add up to the number
/// of limit vertices, but that feet on features and in tiny faces count more. About 0.5
/// microseconds a limit vertex.
std::vector<FootTarget> follow_feet(const relax::InputSurface& input, const domain::Domain& domain,
                                    const relax::SubdividedLevel& finest, const Points& limit,
                                    std::vector<relax::SurfacePoint>& foot_points);

}  // namespace zerotree::fit
