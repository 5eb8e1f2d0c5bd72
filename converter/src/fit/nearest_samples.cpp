#include "fit/nearest_samples.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "measure/closest_point_on_triangle.h"
#include "mesh/error.h"
#include "relax/parallel_loop.h"

namespace zerotree::fit {
namespace {

constexpr std::uint32_t kNone = 0xffffffffu;
// Normals of an input vertex and of its nearest point differ by less than this cosine.
constexpr double kLeastCosine = 0.3;
// A search crosses a few triangles; more than this means that it creeps along a spike.
constexpr int kMostSteps = 200;
// Triangles around a vertex at most; around a base vertex there may be many.
constexpr int kMostInFan = 1000;

// Of each triangle the one across edge k, which runs from corner k to k + 1.
std::vector<Triangle> triangles_across_edges(const relax::SubdividedLevel& level) {
  std::vector<std::array<std::uint32_t, 2>> sides(level.edges.size(), {kNone, kNone});
  for (std::uint32_t f = 0; f < level.triangles.size(); ++f)
    for (std::uint32_t e : level.face_edges[f]) sides[e][sides[e][0] == kNone ? 0 : 1] = f;
  std::vector<Triangle> adjacent(level.triangles.size());
  for (std::uint32_t f = 0; f < adjacent.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& [a, b] = sides[level.face_edges[f][k]];
      adjacent[f][k] = a == f ? b : a;
    }
  return adjacent;
}

}  // namespace

NearestSamples::NearestSamples(const relax::InputSurface& input,
                               const relax::SubdividedLevel& finest,
                               const std::vector<relax::SurfacePoint>& foot_points)
    : input_(input),
      finest_(finest),
      adjacent_(triangles_across_edges(finest)),
      normals_(input.mesh.positions.size(), Eigen::Vector3d::Zero()),
      weights_(normals_.size(), 0.0f),
      samples_(normals_.size()) {
  double total = 0;
  std::vector<double> areas(normals_.size(), 0.0);
  for (std::uint32_t f = 0; f < input.topology.faces.size(); ++f) {
    const Eigen::Vector3d normal = input.face_normal(f);
    const double area = normal.norm();
    total += 3 * area;
    for (std::uint32_t v : input.topology.faces[f]) {
      normals_[v] += normal;
      areas[v] += area;
    }
  }
  for (Eigen::Vector3d& normal : normals_) normal.stableNormalize();
  if (total > 0)
    for (std::size_t v = 0; v < areas.size(); ++v)
      weights_[v] = static_cast<float>(areas[v] / total * finest.vertex_count);
  seed(foot_points);
  spread_seeds();
}

// An input vertex begins where the foot of a limit vertex is next to it.
void NearestSamples::seed(const std::vector<relax::SurfacePoint>& foot_points) {
  for (InputSample& sample : samples_) sample.triangle = kNone;
  for (std::uint32_t t = 0; t < finest_.triangles.size(); ++t)
    for (std::uint32_t v : finest_.triangles[t]) {
      const relax::SurfacePoint& foot = foot_points[v];
      int corner = 0;
      foot.weights.maxCoeff(&corner);
      InputSample& sample =
          samples_[input_.topology.faces[foot.face][static_cast<std::size_t>(corner)]];
      if (sample.triangle == kNone) sample.triangle = t;
    }
}

// The others begin where a neighbour does, which is near enough.
void NearestSamples::spread_seeds() {
  for (bool spreads = true; spreads;) {
    spreads = false;
    for (const Triangle& t : input_.topology.faces)
      for (std::size_t k = 0; k < 3; ++k) {
        std::uint32_t &a = samples_[t[k]].triangle, &b = samples_[t[(k + 1) % 3]].triangle;
        if ((a == kNone) == (b == kNone)) continue;
        a = b = std::min(a, b);  // the one that is there
        spreads = true;
      }
  }
  for (const InputSample& sample : samples_)
    if (sample.triangle == kNone)
      throw Error(ExitCode::internal, "a piece of the input has no part of the new mesh");
}

NearestSamples::Nearest NearestSamples::nearest_on(const Points& limit, std::uint32_t triangle,
                                                   const Eigen::Vector3d& p) const {
  const Triangle& t = finest_.triangles[triangle];
  const Eigen::Vector3d &a = limit[t[0]], &b = limit[t[1]], &c = limit[t[2]];
  const Eigen::Vector3d w = measure::closest_weights_on_triangle(p, a, b, c);
  return {triangle, w, (w[0] * a + w[1] * b + w[2] * c - p).squaredNorm()};
}

// The best of the triangles beyond the edge or around the corner that `at` lies on.
NearestSamples::Nearest NearestSamples::best_neighbour(const Points& limit, const Nearest& at,
                                                       const Eigen::Vector3d& p) const {
  Nearest best = at;
  const auto look_at = [&](std::uint32_t triangle) {
    const Nearest next = nearest_on(limit, triangle, p);
    if (next.squared_distance < best.squared_distance) best = next;
  };
  for (std::size_t k = 0; k < 3; ++k)  // edge k lies opposite corner k + 2
    if (at.weights[static_cast<Eigen::Index>((k + 2) % 3)] == 0 &&
        adjacent_[at.triangle][k] != kNone)
      look_at(adjacent_[at.triangle][k]);
  int corner = 0;
  if (at.weights.maxCoeff(&corner) < 1 || best.squared_distance < at.squared_distance) return best;
  // At a corner, and both neighbours there are no nearer: go round the rest of the fan.
  const std::uint32_t vertex = finest_.triangles[at.triangle][static_cast<std::size_t>(corner)];
  std::uint32_t triangle = at.triangle;
  for (int i = 0; i < kMostInFan; ++i) {
    const Triangle& t = finest_.triangles[triangle];
    const std::size_t k = t[0] == vertex ? 0 : t[1] == vertex ? 1 : 2;
    triangle = adjacent_[triangle][k];
    if (triangle == kNone || triangle == at.triangle) break;
    look_at(triangle);
  }
  return best;
}

NearestSamples::Nearest NearestSamples::go_downhill(const Points& limit, std::uint32_t triangle,
                                                    const Eigen::Vector3d& p) const {
  Nearest at = nearest_on(limit, triangle, p);
  for (int step = 0; step < kMostSteps && at.weights.minCoeff() == 0; ++step) {
    const Nearest next = best_neighbour(limit, at, p);
    if (!(next.squared_distance < at.squared_distance)) break;
    at = next;
  }
  return at;
}

const std::vector<InputSample>& NearestSamples::follow(const Points& limit) {
  relax::for_each_index(samples_.size(), [&](std::size_t v) {
    InputSample& sample = samples_[v];
    const Nearest nearest = go_downhill(limit, sample.triangle, input_.mesh.positions[v]);
    const Triangle& t = finest_.triangles[nearest.triangle];
    const Eigen::Vector3d normal =
        (limit[t[1]] - limit[t[0]]).cross(limit[t[2]] - limit[t[0]]).stableNormalized();
    sample.triangle = nearest.triangle;
    sample.corner_weights = nearest.weights.cast<float>();
    sample.normal = normal.cast<float>();
    sample.weight = normals_[v].dot(normal) < kLeastCosine ? 0.0f : weights_[v];
  });
  return samples_;
}

}  // namespace zerotree::fit
