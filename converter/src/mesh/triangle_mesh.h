// The plain triangle mesh that flows between the stages.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

namespace zerotree {

using Triangle = std::array<std::uint32_t, 3>;

/// An indexed triangle list. Triangles are counter-clockwise seen from outside; positions are in
/// the input's own unit and stay double until they are quantised.
struct TriangleMesh {
  std::vector<Eigen::Vector3d> positions;
  std::vector<Triangle> triangles;
};

/// Length of the diagonal of the axis-aligned bounding box of `positions`; 0 for an empty list.
/// Every relative error in this project is relative to this length of the original input.
inline double bounding_box_diagonal(const std::vector<Eigen::Vector3d>& positions) {
  if (positions.empty()) return 0.0;
  Eigen::Vector3d low = positions.front(), high = positions.front();
  for (const Eigen::Vector3d& p : positions) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return (high - low).norm();
}

}  // namespace zerotree
