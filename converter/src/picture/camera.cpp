#include "picture/camera.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "mesh/error.h"

namespace zerotree::picture {
namespace {

// Half the opening angle of the longer side is about 13 degrees: that of a portrait lens, which
// bends shapes little.
constexpr double portrait_tangent = 0.23;

// What a view must contain, along one image axis with half opening `tangent`: the eye must stand at
// least (right + left) / (2 tangent) away, and (right - left) / 2 to the side.
struct Reach {
  double right = -std::numeric_limits<double>::infinity();
  double left = -std::numeric_limits<double>::infinity();

  void include(double side, double depth, double tangent) {
    right = std::max(right, side + tangent * depth);
    left = std::max(left, -side + tangent * depth);
  }
  double distance(double tangent) const { return (right + left) / (2.0 * tangent); }
  double shift() const { return 0.5 * (right - left); }
};

}  // namespace

UnitFrame unit_frame(const TriangleMesh& mesh) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Eigen::Vector3d low = Eigen::Vector3d::Constant(infinity), high = -low;
  for (const Triangle& t : mesh.triangles)
    for (std::uint32_t v : t) {
      if (v >= mesh.positions.size() || !mesh.positions[v].allFinite())
        throw Error(ExitCode::refused_topology,
                    "cannot draw a mesh whose vertex " + std::to_string(v) +
                        " is missing or not finite: convert or repair it first");
      low = low.cwiseMin(mesh.positions[v]);
      high = high.cwiseMax(mesh.positions[v]);
    }
  const double diagonal = (high - low).norm();
  if (mesh.triangles.empty() || !(diagonal > 0.0))
    throw Error(ExitCode::refused_topology, "cannot draw a mesh that has no surface");
  return {0.5 * (low + high), 2.0 / diagonal};
}

ViewAxes view_axes(const Eigen::Vector3d& back, const Eigen::Vector3d& up) {
  const Eigen::Vector3d b = back.normalized();
  Eigen::Vector3d right = up.cross(b);
  if (right.norm() < 1e-6 * up.norm()) right = b.unitOrthogonal();
  right.normalize();
  return {right.cast<float>(), b.cross(right).cast<float>(), b.cast<float>()};
}

Camera fit_camera(const TriangleMesh& mesh, const Eigen::Vector3d& back, const Eigen::Vector3d& up,
                  double aspect, double margin) {
  Camera camera;
  camera.frame = unit_frame(mesh);
  camera.axes = view_axes(back, up);
  camera.world_up = up.normalized().cast<float>();
  const double longer = std::max(1.0, aspect);
  camera.tangent_x = static_cast<float>(portrait_tangent * aspect / longer);
  camera.tangent_y = static_cast<float>(portrait_tangent / longer);

  const double inside_x = camera.tangent_x * (1.0 - 2.0 * margin);
  const double inside_y = camera.tangent_y * (1.0 - 2.0 * margin);
  Reach across, upwards;
  camera.ground = std::numeric_limits<float>::infinity();
  for (const Triangle& t : mesh.triangles)
    for (std::uint32_t v : t) {
      const Eigen::Vector3f p = camera.frame(mesh.positions[v]);
      const double depth = p.dot(camera.axes.back);
      across.include(p.dot(camera.axes.right), depth, inside_x);
      upwards.include(p.dot(camera.axes.up), depth, inside_y);
      camera.ground = std::min(camera.ground, p.dot(camera.world_up));
    }
  const double distance = std::max(across.distance(inside_x), upwards.distance(inside_y));
  camera.eye = static_cast<float>(distance) * camera.axes.back +
               static_cast<float>(across.shift()) * camera.axes.right +
               static_cast<float>(upwards.shift()) * camera.axes.up;
  return camera;
}

}  // namespace zerotree::picture
