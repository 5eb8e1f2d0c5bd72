#include "fit/turned_faces.h"

#include <Eigen/Geometry>

#include "relax/parallel_loop.h"

namespace zerotree::fit {
namespace {

// Rounds of smoothing; each reaches one ring further where faces stay turned.
constexpr int kMostRounds = 30;

Points smooth_normals(const relax::InputSurface& input) {
  Points normals(input.mesh.positions.size(), Eigen::Vector3d::Zero());
  for (std::uint32_t f = 0; f < input.topology.faces.size(); ++f) {
    const Eigen::Vector3d normal = input.face_normal(f);
    for (std::uint32_t v : input.topology.faces[f]) normals[v] += normal;
  }
  for (Eigen::Vector3d& normal : normals) normal.stableNormalize();
  return normals;
}

bool is_turned(const relax::InputSurface& input, const Points& normals,
               const std::vector<relax::SurfacePoint>& foot_points, const Points& limit,
               const Triangle& t) {
  const Eigen::Vector3d normal = (limit[t[1]] - limit[t[0]]).cross(limit[t[2]] - limit[t[0]]);
  const Eigen::Vector3d centre = (limit[t[0]] + limit[t[1]] + limit[t[2]]) / 3;
  for (std::uint32_t v : t) {
    if (foot_points[v].edge >= 0) continue;
    const relax::SurfacePoint at =
        relax::walk_on_surface(input, foot_points[v], centre - input.position(foot_points[v]));
    const Triangle& corners = input.topology.faces[at.face];
    const Eigen::Vector3d there = at.weights[0] * normals[corners[0]] +
                                  at.weights[1] * normals[corners[1]] +
                                  at.weights[2] * normals[corners[2]];
    // Seen from one corner with the input's own face or its smooth normal: noise is no turn.
    return normal.dot(there) < 0 && normal.dot(input.face_normal(at.face)) < 0;
  }
  return false;
}

// Every marked vertex goes to the mean of its neighbours.
void smooth_marked(const relax::SubdividedLevel& finest,
                   const std::vector<relax::SurfacePoint>& foot_points,
                   const std::vector<std::uint8_t>& marked, Points& points) {
  Points sums(points.size(), Eigen::Vector3d::Zero());
  std::vector<std::uint32_t> counts(points.size(), 0);
  for (const auto& [a, b] : finest.edges) {
    sums[a] += points[b];
    sums[b] += points[a];
    ++counts[a];
    ++counts[b];
  }
  for (std::size_t v = 0; v < points.size(); ++v)
    if (marked[v] && foot_points[v].edge < 0) points[v] = sums[v] / counts[v];
}

}  // namespace

std::vector<std::uint32_t> find_turned_faces(const relax::InputSurface& input,
                                             const relax::SubdividedLevel& finest,
                                             const std::vector<relax::SurfacePoint>& foot_points,
                                             const Points& limit) {
  const Points normals = smooth_normals(input);
  std::vector<std::uint8_t> flags(finest.triangles.size());
  relax::for_each_index(flags.size(), [&](std::size_t f) {
    flags[f] = is_turned(input, normals, foot_points, limit, finest.triangles[f]);
  });
  std::vector<std::uint32_t> turned;
  for (std::uint32_t f = 0; f < flags.size(); ++f)
    if (flags[f]) turned.push_back(f);
  return turned;
}

std::uint32_t turn_faces_back(const relax::InputSurface& input,
                              const relax::SubdividedLevel& finest, const LimitOperator& limit,
                              const std::vector<relax::SurfacePoint>& foot_points, Points& points) {
  std::vector<std::uint8_t> marked(points.size(), 0);
  Points at;
  for (int round = 0;; ++round) {
    limit.apply(points, at);
    const std::vector<std::uint32_t> turned = find_turned_faces(input, finest, foot_points, at);
    if (turned.empty() || round == kMostRounds) return static_cast<std::uint32_t>(turned.size());
    for (std::uint32_t f : turned)
      for (std::uint32_t v : finest.triangles[f]) marked[v] = 1;
    smooth_marked(finest, foot_points, marked, points);
  }
}

}  // namespace zerotree::fit
