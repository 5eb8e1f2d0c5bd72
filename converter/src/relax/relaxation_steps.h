// Where the vertices of a level want to go.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "relax/surface_vertices.h"

namespace zerotree::relax {

/// A step for each vertex of a working level: tangential at the unit normal beside it.
struct Steps {
  std::vector<Eigen::Vector3d> steps;
  std::vector<Eigen::Vector3d> normals;
};

/// Damped Jacobi steps of the vertices of `level` (at most the working one) towards the mean of
/// their neighbours, and the same for the finer vertices between them by interpolation.
///
/// The energy is the sum over the working level's triangles of area^1.25 x squared edges x the
/// density that is wanted there; curves have the squared lengths of their pieces. The forces of the
/// working level are restricted to `level` and its steps prolonged again by hat functions, vectors
/// being turned with the surface: one smoothing step of a multigrid cycle. Meant to be reused:
/// holds scratch memory.
class RelaxationSteps {
 public:
  const Steps& towards_means(const SurfaceVertices& vertices, int level);
  /// Steps of the odd vertices of the working level towards where Loop's rule predicts them from
  /// the even ones: the details that are left then point off the surface. `share` of the way.
  const Steps& towards_prediction(const SurfaceVertices& vertices, double share);

 private:
  void weigh_faces(const SurfaceVertices& vertices);
  void gather_forces(const SurfaceVertices& vertices);
  void restrict_to(const SurfaceVertices& vertices, int level);
  void scale(const SurfaceVertices& vertices, int level);
  void prolong(const SurfaceVertices& vertices, int level);

  Steps steps_;
  std::vector<double> stiffness_, face_weights_, lengths_;
  std::vector<std::uint32_t> valences_;
};

}  // namespace zerotree::relax
