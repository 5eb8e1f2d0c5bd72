// What the input wants of the limit surface: planes, curves and places to go through.
#pragma once

#include <Eigen/Core>
#include <cstdint>
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
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  double weight = 0;
};

/// Of an input vertex: the point of the limit mesh nearest to it, and the unit normal there. The
/// limit surface should pass through the vertex, which may slide along.
struct InputSample {
  std::uint32_t triangle = 0;
  Eigen::Vector3f corner_weights = Eigen::Vector3f::Zero();
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();
  float weight = 0;
};

/// Both directions of the distance. The weights of either add up to the number of limit vertices,
/// but that feet on features count more.
struct FitTargets {
  std::vector<FootTarget> feet;
  std::vector<InputSample> samples;
};

/// Finds the targets of the limit mesh `limit`, `finest`. `foot_points` are the feet of its
/// vertices as known so far: they are led on by short walks along the input. Input vertices whose
/// nearest point lies on the other side of a thin sheet get no weight.
/// Cost: about 2 microseconds per input vertex and 0.5 per limit vertex, 150 bytes per triangle.
FitTargets find_targets(const relax::InputSurface& input, const domain::Domain& domain,
                        const relax::SubdividedLevel& finest, const Points& limit,
                        std::vector<relax::SurfacePoint>& foot_points);

}  // namespace zerotree::fit
