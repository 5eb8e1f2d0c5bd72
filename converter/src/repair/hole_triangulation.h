// Triangles that close a polygon in space.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <vector>

#include "mesh/triangle_mesh.h"

namespace zerotree::repair {

/// A closed polygon, counter-clockwise as its filling will be seen.
struct Rim {
  std::vector<Eigen::Vector3d> points;
  /// Unit normal of the face beyond the edge from point i to the next.
  std::vector<Eigen::Vector3d> normals_beyond;
  /// Whether an edge between two points of the rim that are not neighbours may be made.
  std::function<bool(std::uint32_t, std::uint32_t)> may_connect;
};

/// Triangles over the indices of the points; empty if the edges that may be made do not allow any.
/// Up to 200 points the triangulation whose worst fold is least, and of these the one of least area
/// (Liepa 2003); beyond, ears are cut by the length of their new edge.
std::vector<Triangle> triangulate_rim(const Rim& rim);

}  // namespace zerotree::repair
