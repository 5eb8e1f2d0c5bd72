#include "picture/automatic_view.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "picture/camera.h"
#include "picture/mesh_picture.h"
#include "picture/ray_scene.h"

namespace zerotree::picture {
namespace {

// Share of the model's footprint on the plane across `up` that the box of its lowest 4 % covers.
double foot_share(const TriangleMesh& mesh, const UnitFrame& frame, const Eigen::Vector3f& up) {
  const Eigen::Vector3f a = up.unitOrthogonal(), b = up.cross(a);
  const auto turned = [&](std::uint32_t v) {
    const Eigen::Vector3f p = frame(mesh.positions[v]);
    return Eigen::Vector3f(p.dot(a), p.dot(b), p.dot(up));
  };
  Eigen::AlignedBox3f whole, foot;
  for (const Triangle& t : mesh.triangles)
    for (std::uint32_t v : t) whole.extend(turned(v));
  const float limit = whole.min().z() + 0.04F * whole.sizes().z();
  for (const Triangle& t : mesh.triangles)
    for (std::uint32_t v : t) {
      const Eigen::Vector3f p = turned(v);
      if (p.z() <= limit) foot.extend(p);
    }
  const float area = whole.sizes().x() * whole.sizes().y();
  return area > 0.0F ? static_cast<double>(foot.sizes().x() * foot.sizes().y() / area) : 0.0;
}

// How much the normals turn from pixel to pixel, summed over a small image: silhouettes do not
// count, for there one of the two pixels is empty or the turn is cut off.
double visible_relief(const TriangleMesh& mesh, const RayScene& scene,
                      const std::vector<Eigen::Vector3f>& normals, const Camera& camera) {
  constexpr int size = 80;
  constexpr float largest_turn = 0.6F;
  std::vector<std::optional<Eigen::Vector3f>> seen(size * size);
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      const Eigen::Vector3f direction =
          camera.ray((static_cast<float>(x) + 0.5F) / size, (static_cast<float>(y) + 0.5F) / size)
              .normalized();
      const std::optional<RayHit> hit = scene.first_hit(camera.eye, direction);
      if (!hit) continue;
      const Triangle& t = mesh.triangles[hit->triangle];
      seen[y * size + x] = (1.0F - hit->u - hit->v) * normals[t[0]] + hit->u * normals[t[1]] +
                           hit->v * normals[t[2]];
    }
  double relief = 0.0;
  for (int y = 0; y < size; ++y)
    for (int x = 0; x + 1 < size; ++x) {
      const auto& here = seen[y * size + x];
      const auto& right = seen[y * size + x + 1];
      if (here && right) relief += std::min(largest_turn, (*here - *right).norm());
    }
  return relief;
}

}  // namespace

Eigen::Vector3d automatic_up(const TriangleMesh& mesh) {
  constexpr double clearly = 1.5;
  const UnitFrame frame = unit_frame(mesh);
  Eigen::Vector3d best = Eigen::Vector3d::UnitY();
  double to_beat = clearly * foot_share(mesh, frame, best.cast<float>());
  for (const Eigen::Vector3d& up :
       {Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(0, 0, -1), Eigen::Vector3d(0, -1, 0)}) {
    const double share = foot_share(mesh, frame, up.cast<float>());
    if (share <= to_beat) continue;
    to_beat = share;
    best = up;
  }
  return best;
}

Eigen::Vector3d automatic_view(const TriangleMesh& mesh, const Eigen::Vector3d& up) {
  constexpr int directions = 12;
  const double elevation = 14.0 * std::numbers::pi / 180.0;
  const RayScene scene(mesh, unit_frame(mesh));
  const std::vector<Eigen::Vector3f> normals = vertex_normals(mesh);
  const Eigen::Vector3d u = up.normalized(), side = u.unitOrthogonal(), front = side.cross(u);
  Eigen::Vector3d best = front;
  double most = -1.0;
  for (int k = 0; k < directions; ++k) {
    const double turn = 2.0 * std::numbers::pi * (k + 0.5) / directions;
    const Eigen::Vector3d back =
        std::cos(elevation) * (std::cos(turn) * front + std::sin(turn) * side) +
        std::sin(elevation) * u;
    const double relief =
        visible_relief(mesh, scene, normals, fit_camera(mesh, back, up, 1.0, 0.02));
    if (relief > most) {
      most = relief;
      best = back;
    }
  }
  return best;
}

}  // namespace zerotree::picture
