#include "fit/fit_targets.h"

#include <Eigen/Geometry>
#include <cmath>

#include "measure/surface_index.h"
#include "relax/parallel_loop.h"

namespace zerotree::fit {
namespace {

// Normals of an input vertex and of its nearest point differ by less than this cosine.
constexpr double kLeastCosine = 0.3;
// Walks from the last foot of a limit point to the present one.
constexpr int kFootSteps = 2;
// The weight of a vertex in a point that lies on it.
constexpr double kAtVertex = 1 - 1e-9;

Eigen::Vector3d triangle_normal(const Points& p, const Triangle& t) {
  return (p[t[1]] - p[t[0]]).cross(p[t[2]] - p[t[0]]);
}

// Normals of vertices, as long as a third of their faces' areas would have them.
Points vertex_normals(const Points& positions, const std::vector<Triangle>& triangles,
                      std::vector<double>& areas) {
  Points normals(positions.size(), Eigen::Vector3d::Zero());
  areas.assign(positions.size(), 0.0);
  double total = 0;
  for (const Triangle& t : triangles) {
    const Eigen::Vector3d normal = triangle_normal(positions, t);
    const double area = normal.norm();
    total += 3 * area;
    for (std::uint32_t v : t) {
      normals[v] += normal;
      areas[v] += area;
    }
  }
  if (total > 0)
    for (double& area : areas) area /= total;
  return normals;
}

// Whether a point lies on a vertex that stays where it is.
bool is_at_corner(const relax::InputSurface& input, const domain::Domain& domain,
                  const relax::SurfacePoint& point) {
  int corner = 0;
  if (point.weights.maxCoeff(&corner) < kAtVertex) return false;
  const std::uint32_t vertex = input.topology.faces[point.face][static_cast<std::size_t>(corner)];
  return domain.kinds[vertex] == domain::VertexKind::corner;
}

FootTarget follow(const relax::InputSurface& input, const domain::Domain& domain,
                  const Eigen::Vector3d& limit, relax::SurfacePoint& foot) {
  FootTarget target;
  target.position = input.position(foot);
  if (is_at_corner(input, domain, foot)) return target;
  const bool on_curve = foot.edge >= 0;
  for (int i = 0; i < kFootSteps; ++i) {
    const Eigen::Vector3d way = limit - input.position(foot);
    foot = on_curve ? relax::walk_along_feature(input, domain.kinds, foot, way)
                    : relax::walk_on_surface(input, foot, way);
  }
  target.position = input.position(foot);
  if (!on_curve) target.normal = input.face_normal(foot.face).stableNormalized();
  return target;
}

InputSample nearest_sample(const measure::SurfaceIndex& index, const TriangleMesh& limit,
                           const Eigen::Vector3d& position, const Eigen::Vector3d& normal,
                           double weight) {
  const measure::SurfacePoint nearest = index.closest(position);
  const Triangle& t = limit.triangles[nearest.triangle];
  const Eigen::Vector3d e1 = limit.positions[t[1]] - limit.positions[t[0]];
  const Eigen::Vector3d e2 = limit.positions[t[2]] - limit.positions[t[0]];
  const Eigen::Vector3d to = nearest.position - limit.positions[t[0]];
  const double a = e1.squaredNorm(), b = e1.dot(e2), c = e2.squaredNorm();
  const double d1 = to.dot(e1), d2 = to.dot(e2), determinant = a * c - b * b;
  const double w1 = (c * d1 - b * d2) / determinant, w2 = (a * d2 - b * d1) / determinant;
  const Eigen::Vector3d plane = e1.cross(e2).stableNormalized();
  InputSample sample;
  sample.triangle = nearest.triangle;
  if (!std::isfinite(w1) || !std::isfinite(w2)) return sample;
  if (normal.stableNormalized().dot(plane) < kLeastCosine) return sample;
  sample.corner_weights = Eigen::Vector3d(1 - w1 - w2, w1, w2).cast<float>();
  sample.normal = plane.cast<float>();
  sample.weight = static_cast<float>(weight);
  return sample;
}

}  // namespace

FitTargets find_targets(const relax::InputSurface& input, const domain::Domain& domain,
                        const relax::SubdividedLevel& finest, const Points& limit,
                        std::vector<relax::SurfacePoint>& foot_points) {
  FitTargets targets;
  const double total = static_cast<double>(limit.size());
  std::vector<double> areas;
  vertex_normals(limit, finest.triangles, areas);
  targets.feet.resize(limit.size());
  relax::for_each_index(limit.size(), [&](std::size_t v) {
    targets.feet[v] = follow(input, domain, limit[v], foot_points[v]);
    targets.feet[v].weight = areas[v] * total;
  });

  const Points& positions = input.mesh.positions;
  const Points normals = vertex_normals(positions, input.topology.faces, areas);
  const TriangleMesh limit_mesh{limit, finest.triangles};
  const measure::SurfaceIndex index(limit_mesh, 1);
  targets.samples.resize(positions.size());
  relax::for_each_index(positions.size(), [&](std::size_t v) {
    targets.samples[v] =
        nearest_sample(index, limit_mesh, positions[v], normals[v], areas[v] * total);
  });
  return targets;
}

}  // namespace zerotree::fit
