#include "fit/input_orientation.h"

#include <Eigen/Geometry>
#include <limits>

namespace zerotree::fit {
namespace {

// The weight of a vertex in a point that lies on it.
constexpr double kAtVertex = 1 - 1e-9;

}  // namespace

InputOrientation::InputOrientation(const relax::InputSurface& input)
    : input_(input), normals_(input.mesh.positions.size(), Eigen::Vector3d::Zero()) {
  const std::vector<Triangle>& faces = input.topology.faces;
  for (std::uint32_t f = 0; f < faces.size(); ++f) {
    const Eigen::Vector3d normal = input.face_normal(f);
    for (std::uint32_t v : faces[f]) normals_[v] += normal;
  }
  for (Eigen::Vector3d& normal : normals_) normal.stableNormalize();
  for (std::uint32_t f = 0; f < faces.size(); ++f)
    for (int k = 0; k < 3; ++k)
      if (domain::is_feature(input.topology, f, k))
        for (int end : {k, domain::kNext[k]})
          normals_[faces[f][static_cast<std::size_t>(end)]].setZero();
}

bool InputOrientation::is_on_feature(const relax::SurfacePoint& point) const {
  int corner = 0;
  return point.edge >= 0 ||
         (point.weights.maxCoeff(&corner) >= kAtVertex &&
          normals_[input_.topology.faces[point.face][static_cast<std::size_t>(corner)]].isZero(0));
}

Eigen::Vector3d InputOrientation::smooth_normal(const relax::SurfacePoint& point) const {
  const Eigen::Vector3d own = input_.face_normal(point.face).stableNormalized();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d& at =
        normals_[input_.topology.faces[point.face][static_cast<std::size_t>(k)]];
    normal += point.weights[k] * (at.isZero(0) ? own : at);
  }
  return normal.stableNormalized();
}

bool InputOrientation::find_point(const std::vector<relax::SurfacePoint>& feet, const Points& limit,
                                  const Triangle& t, relax::SurfacePoint& point) const {
  const Eigen::Vector3d centre = (limit[t[0]] + limit[t[1]] + limit[t[2]]) / 3;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::uint32_t v : t) {
    if (is_on_feature(feet[v])) continue;
    const relax::SurfacePoint at =
        relax::walk_on_surface(input_, feet[v], centre - input_.position(feet[v]));
    const double distance = (centre - input_.position(at)).squaredNorm();
    if (distance >= nearest) continue;
    nearest = distance;
    point = at;
  }
  return nearest < std::numeric_limits<double>::infinity();
}

bool InputOrientation::opposes(const relax::SurfacePoint& point,
                               const Eigen::Vector3d& normal) const {
  return normal.dot(input_.face_normal(point.face)) < 0 && normal.dot(smooth_normal(point)) < 0;
}

bool InputOrientation::is_turned(const std::vector<relax::SurfacePoint>& feet, const Points& limit,
                                 const Triangle& t) const {
  relax::SurfacePoint point;
  return find_point(feet, limit, t, point) &&
         opposes(point, (limit[t[1]] - limit[t[0]]).cross(limit[t[2]] - limit[t[0]]));
}

}  // namespace zerotree::fit
