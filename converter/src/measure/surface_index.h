// Nearest points of a triangle mesh, exact in double precision.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <memory>

#include "mesh/triangle_mesh.h"

namespace zerotree::measure {

/// A point of an indexed surface.
struct SurfacePoint {
  static constexpr std::uint32_t no_triangle = std::numeric_limits<std::uint32_t>::max();

  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  /// Squared distance to the point asked for.
  double distance_squared = std::numeric_limits<double>::infinity();
  /// Index into the mesh's triangles; the lowest one where several are equally near.
  std::uint32_t triangle = no_triangle;
};

/// A bounding volume hierarchy (Embree) over the triangles of positive area of one mesh. It refers
/// to the mesh, which must outlive it unchanged. Queries may run on many threads at once, and an
/// answer depends on nothing but the mesh and the point: not on threads, hints or the machine.
///
/// Cost: about 150 bytes and 0.5 microseconds per triangle to build, about a microsecond a query.
class SurfaceIndex {
 public:
  /// `threads` may build it; 0 means all of the machine's.
  /// Throws Error(refused_topology) if the mesh has no triangle of positive area, a position that
  /// is not finite or an index out of range; Error(memory_limit) if memory runs out.
  explicit SurfaceIndex(const TriangleMesh& mesh, int threads = 0);
  ~SurfaceIndex();
  SurfaceIndex(SurfaceIndex&&) noexcept;
  SurfaceIndex& operator=(SurfaceIndex&&) noexcept;

  /// The point of the surface nearest to `p` (finite). `hint` is a triangle expected to be near,
  /// such as the answer of a neighbouring query: it makes the search faster and changes nothing.
  SurfacePoint closest(const Eigen::Vector3d& p,
                       std::uint32_t hint = SurfacePoint::no_triangle) const;

  const TriangleMesh& mesh() const;

 private:
  struct Bvh;
  std::unique_ptr<Bvh> bvh_;
};

}  // namespace zerotree::measure
