#include "fit/turned_faces.h"

#include <Eigen/Geometry>
#include <limits>
#include <numeric>
#include <utility>

#include "relax/parallel_loop.h"

namespace zerotree::fit {
namespace {

// Rounds of smoothing at most, and rounds without gain after which it is given up.
constexpr int kMostRounds = 5;
constexpr int kPatience = 2;
// Smoothing is felt so many rings away.
constexpr int kWatchedRings = 3;
// How far a vertex goes towards the mean of its neighbours.
constexpr double kSmoothing = 0.5;

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
  double nearest = std::numeric_limits<double>::infinity();
  bool turned = false;
  for (std::uint32_t v : t) {
    if (foot_points[v].edge >= 0) continue;
    const relax::SurfacePoint at =
        relax::walk_on_surface(input, foot_points[v], centre - input.position(foot_points[v]));
    const double distance = (centre - input.position(at)).squaredNorm();
    if (distance >= nearest) continue;
    nearest = distance;
    const Triangle& corners = input.topology.faces[at.face];
    const Eigen::Vector3d smooth = at.weights[0] * normals[corners[0]] +
                                   at.weights[1] * normals[corners[1]] +
                                   at.weights[2] * normals[corners[2]];
    // By the input's own face and by its smooth normal: noise is no turn.
    turned = normal.dot(smooth) < 0 && normal.dot(input.face_normal(at.face)) < 0;
  }
  return turned;
}

std::vector<std::uint32_t> turned_among(const relax::InputSurface& input, const Points& normals,
                                        const std::vector<relax::SurfacePoint>& foot_points,
                                        const Points& limit, const relax::SubdividedLevel& finest,
                                        const std::vector<std::uint32_t>& faces) {
  std::vector<std::uint8_t> flags(faces.size());
  relax::for_each_index(faces.size(), [&](std::size_t i) {
    flags[i] = is_turned(input, normals, foot_points, limit, finest.triangles[faces[i]]);
  });
  std::vector<std::uint32_t> turned;
  for (std::size_t i = 0; i < faces.size(); ++i)
    if (flags[i]) turned.push_back(faces[i]);
  return turned;
}

// The faces within `rings` rings of vertices around the given ones.
std::vector<std::uint32_t> faces_near(const relax::SubdividedLevel& finest,
                                      const std::vector<std::uint32_t>& faces, int rings) {
  std::vector<std::uint8_t> near(finest.vertex_count, 0);
  for (std::uint32_t f : faces)
    for (std::uint32_t v : finest.triangles[f]) near[v] = 1;
  for (int ring = 0; ring < rings; ++ring) {
    const std::vector<std::uint8_t> inner = near;
    for (const auto& [a, b] : finest.edges)
      if (inner[a] || inner[b]) near[a] = near[b] = 1;
  }
  std::vector<std::uint32_t> result;
  for (std::uint32_t f = 0; f < finest.triangles.size(); ++f)
    if (near[finest.triangles[f][0]] || near[finest.triangles[f][1]] ||
        near[finest.triangles[f][2]])
      result.push_back(f);
  return result;
}

// The vertices of the turned faces go half the way to the mean of their neighbours.
void smooth_faces(const relax::SubdividedLevel& finest, const std::vector<std::uint8_t>& held,
                  const std::vector<std::uint32_t>& turned, Points& points) {
  std::vector<std::uint8_t> marked(points.size(), 0);
  for (std::uint32_t f : turned)
    for (std::uint32_t v : finest.triangles[f]) marked[v] = !held[v];
  Points sums(points.size(), Eigen::Vector3d::Zero());
  std::vector<std::uint32_t> counts(points.size(), 0);
  for (const auto& [a, b] : finest.edges) {
    if (!marked[a] && !marked[b]) continue;
    sums[a] += points[b];
    sums[b] += points[a];
    ++counts[a];
    ++counts[b];
  }
  for (std::size_t v = 0; v < points.size(); ++v)
    if (marked[v]) points[v] += kSmoothing * (sums[v] / counts[v] - points[v]);
}

}  // namespace

std::uint32_t turn_faces_back(const relax::InputSurface& input,
                              const relax::SubdividedLevel& finest, const LimitOperator& limit,
                              const std::vector<relax::SurfacePoint>& foot_points,
                              const std::vector<std::uint8_t>& held, Points& points) {
  const Points normals = smooth_normals(input);
  std::vector<std::uint32_t> watched(finest.triangles.size());
  std::iota(watched.begin(), watched.end(), 0u);
  Points at, best = points;
  std::size_t least = 0;
  int without_gain = 0;
  for (int round = 0; round <= kMostRounds; ++round) {
    limit.apply(points, at);
    const std::vector<std::uint32_t> turned =
        turned_among(input, normals, foot_points, at, finest, watched);
    if (round == 0) watched = faces_near(finest, turned, kWatchedRings);
    const bool is_better = round == 0 || turned.size() < least;
    without_gain = is_better ? 0 : without_gain + 1;
    if (is_better) {
      least = turned.size();
      best = points;
    }
    if (turned.empty() || without_gain == kPatience) break;
    smooth_faces(finest, held, turned, points);
  }
  points = std::move(best);
  return static_cast<std::uint32_t>(least);
}

}  // namespace zerotree::fit
