// Walking on the input surface: straight on over its faces, or along a feature curve.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "domain/domain.h"
#include "mesh/triangle_mesh.h"

namespace zerotree::relax {

/// `v` made of unit length; zero stays.
inline Eigen::Vector3d unit(const Eigen::Vector3d& v) {
  const double length = v.norm();
  return length > 0 ? (v / length).eval() : v;
}

/// A point of the input surface.
struct SurfacePoint {
  std::uint32_t face = 0;
  /// Of a point that keeps to a feature curve: the edge of `face` that it lies on; else -1.
  std::int32_t edge = -1;
  /// Weights of the face's corners: not negative, sum 1.
  Eigen::Vector3d weights = Eigen::Vector3d::Zero();
};

/// The mesh that points walk on. Refers to its parts.
struct InputSurface {
  const TriangleMesh& mesh;
  const domain::TriangleTopology& topology;

  Eigen::Vector3d corner(std::uint32_t face, int k) const {
    return mesh.positions[topology.faces[face][static_cast<std::size_t>(k)]];
  }
  Eigen::Vector3d position(const SurfacePoint& point) const {
    return point.weights[0] * corner(point.face, 0) + point.weights[1] * corner(point.face, 1) +
           point.weights[2] * corner(point.face, 2);
  }
  /// Not of unit length: twice the face's area.
  Eigen::Vector3d face_normal(std::uint32_t face) const;
};

/// The point reached from `start` by going the part of `displacement` in its face's plane, straight
/// on over edges (unfolded). Ends at creases and at the boundary. A face without area is crossed,
/// but from one there is no way.
SurfacePoint walk_on_surface(const InputSurface& surface, const SurfacePoint& start,
                             const Eigen::Vector3d& displacement);

/// The point reached from `start`, which has an edge, by going along its feature curve by the part
/// of `displacement` along it. Ends before vertices that are no `chain`.
SurfacePoint walk_along_feature(const InputSurface& surface,
                                const std::vector<domain::VertexKind>& kinds,
                                const SurfacePoint& start, const Eigen::Vector3d& displacement);

/// Gives a point that lies on a feature curve its edge. Returns whether there is one.
bool snap_to_feature(const InputSurface& surface, SurfacePoint& point);

}  // namespace zerotree::relax
