// Moving all vertices at once without turning a triangle over.
#pragma once

#include <cstdint>
#include <vector>

#include "relax/relaxation_steps.h"
#include "relax/surface_vertices.h"

namespace zerotree::relax {

/// Takes every step that leaves the triangles positive in the parameter domain. First all vertices
/// move; those of triangles that turned over go back, until none has; then these try parts of their
/// steps one after the other. Triangles that were not positive before get no say, but no more of
/// them arise. The result does not depend on the number of threads. Meant to be reused: holds
/// scratch memory.
class GuardedMove {
 public:
  void move(SurfaceVertices& vertices, const Steps& steps);
  /// Lets some vertices, ascending, try parts of their steps one after the other. No more triangles
  /// are negative afterwards.
  void move_alone(SurfaceVertices& vertices, const Steps& steps,
                  const std::vector<std::uint32_t>& some);
  /// How many moves were taken back so far.
  std::uint64_t rejected() const { return rejected_; }

 private:
  void take_back(SurfaceVertices& vertices);
  bool was_positive(const SurfaceVertices& vertices, const Triangle& t) const;
  void retry(SurfaceVertices& vertices, const Steps& steps);
  bool try_alone(SurfaceVertices& vertices, const Steps& steps, std::uint32_t vertex) const;
  void gather_faces(const SurfaceVertices& vertices);

  std::uint64_t rejected_ = 0;
  std::vector<SurfacePoint> before_;
  std::vector<std::uint8_t> is_back_, is_dirty_, is_turned_;
  // The vertices that went back and their faces, one after the other.
  std::vector<std::uint32_t> back_, first_face_, faces_;
};

}  // namespace zerotree::relax
