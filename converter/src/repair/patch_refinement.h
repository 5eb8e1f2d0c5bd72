// Makes the filling of a hole as dense and as smooth as the surface around it.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <vector>

#include "mesh/triangle_mesh.h"

namespace zerotree::repair {

/// A patch over a rim: points 0 to rim_size - 1 are the rim and stay.
struct Patch {
  std::vector<Eigen::Vector3d> points;
  std::vector<Triangle> triangles;
  std::uint32_t rim_size = 0;
};

/// Adds points to `patch` until its edges are as long as those of the rim (Liepa 2003): triangles
/// that are too large are split at their centroid, and edges flipped towards Delaunay.
/// `may_connect` as in Rim.
void refine_patch(Patch& patch,
                  const std::function<bool(std::uint32_t, std::uint32_t)>& may_connect);

/// Moves the points that are not on the rim so that the Laplacians of all points are least in the
/// sum of squares: a thin plate. `outside` holds the neighbours of each rim point outside the
/// patch.
void smooth_patch(Patch& patch, const std::vector<std::vector<Eigen::Vector3d>>& outside);

}  // namespace zerotree::repair
