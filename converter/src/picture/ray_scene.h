// Rays against one mesh.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>

#include "mesh/triangle_mesh.h"
#include "picture/camera.h"

namespace zerotree::picture {

/// Where a ray first meets the mesh: position = (1 - u - v) a + u b + v c in triangle (a, b, c).
struct RayHit {
  float distance = 0.0F;
  std::uint32_t triangle = 0;
  float u = 0.0F, v = 0.0F;
  /// Of the triangle's plane, unit length, on the side of its orientation.
  Eigen::Vector3f plane_normal;
};

/// A mesh in the unit frame, ready for rays (Embree). Queries may run on many threads at once.
class RayScene {
 public:
  /// Copies what it needs. Throws Error(refused_topology) for indices out of range or positions
  /// that are not finite, Error(memory_limit) if memory runs out.
  RayScene(const TriangleMesh& mesh, const UnitFrame& frame);
  ~RayScene();
  RayScene(const RayScene&) = delete;
  RayScene& operator=(const RayScene&) = delete;

  /// `direction` has unit length.
  std::optional<RayHit> first_hit(const Eigen::Vector3f& origin,
                                  const Eigen::Vector3f& direction) const;
  /// Whether anything lies on the ray within `reach`.
  bool blocked(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction,
               float reach = std::numeric_limits<float>::infinity()) const;

 private:
  struct Scene;
  std::unique_ptr<Scene> scene_;
};

}  // namespace zerotree::picture
