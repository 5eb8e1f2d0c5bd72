#include "fit/foot_targets.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "relax/parallel_loop.h"

namespace zerotree::fit {
namespace {

// Features are thin: what a foot on one counts against a foot on the surface.
constexpr double kFeatureWeight = 8;
// The least area that a foot counts for, in units of the mean: where faces are tiny, the penalty,
// which knows no areas, would win over the distances and put loops into rims.
constexpr double kLeastArea = 0.2;
// Walks from the last foot of a limit point to the present one.
constexpr int kFootSteps = 2;
// The weight of a vertex in a point that lies on it.
constexpr double kAtVertex = 1 - 1e-9;

// The share of the surface that belongs to each vertex, times the number of vertices.
std::vector<double> relative_areas(const Points& positions,
                                   const std::vector<Triangle>& triangles) {
  std::vector<double> areas(positions.size(), 0.0);
  double total = 0;
  for (const Triangle& t : triangles) {
    const Points& p = positions;
    const double area = (p[t[1]] - p[t[0]]).cross(p[t[2]] - p[t[0]]).norm();
    total += 3 * area;
    for (std::uint32_t v : t) areas[v] += area;
  }
  if (total > 0)
    for (double& area : areas) area *= static_cast<double>(positions.size()) / total;
  return areas;
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
    const Eigen::Vector3d way = limit - target.position;
    foot = on_curve ? relax::walk_along_feature(input, domain.kinds, foot, way)
                    : relax::walk_on_surface(input, foot, way);
    target.position = input.position(foot);
  }
  if (!on_curve) target.normal = input.face_normal(foot.face).stableNormalized().cast<float>();
  return target;
}

}  // namespace

std::vector<FootTarget> follow_feet(const relax::InputSurface& input, const domain::Domain& domain,
                                    const relax::SubdividedLevel& finest, const Points& limit,
                                    std::vector<relax::SurfacePoint>& foot_points) {
  const std::vector<double> areas = relative_areas(limit, finest.triangles);
  std::vector<FootTarget> feet(limit.size());
  relax::for_each_index(limit.size(), [&](std::size_t v) {
    feet[v] = follow(input, domain, limit[v], foot_points[v]);
    const double share = feet[v].is_on_feature() ? kFeatureWeight : 1.0;
    feet[v].weight = static_cast<float>(share * std::max(areas[v], kLeastArea));
  });
  return feet;
}

}  // namespace zerotree::fit
