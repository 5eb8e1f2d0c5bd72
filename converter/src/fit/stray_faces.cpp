#include "fit/stray_faces.h"

#include <algorithm>

namespace zerotree::fit {
namespace {

// A face is long beyond so many times the root of the mean squared edge, and far off if its centre
// is farther from the input than this share of its longest edge.
constexpr double kLong = 3;
constexpr double kFarShare = 0.25;
constexpr int kRounds = 8;
// How far a control point goes towards the mean of its neighbours.
constexpr double kStep = 0.5;

double longest_squared_edge(const Points& p, const Triangle& t) {
  return std::max({(p[t[0]] - p[t[1]]).squaredNorm(), (p[t[1]] - p[t[2]]).squaredNorm(),
                   (p[t[2]] - p[t[0]]).squaredNorm()});
}

double mean_squared_edge(const relax::SubdividedLevel& level, const Points& p) {
  double sum = 0;
  for (const auto& [a, b] : level.edges) sum += (p[a] - p[b]).squaredNorm();
  return sum / std::max<double>(1, static_cast<double>(level.edges.size()));
}

std::vector<std::uint32_t> find_stray(const InputOrientation& orientation,
                                      const relax::SubdividedLevel& finest,
                                      const std::vector<relax::SurfacePoint>& feet,
                                      const Points& limit, double squared_length) {
  std::vector<std::uint32_t> stray;
  for (std::uint32_t f = 0; f < finest.triangles.size(); ++f) {
    const Triangle& t = finest.triangles[f];
    const double longest = longest_squared_edge(limit, t);
    relax::SurfacePoint point;
    if (longest < squared_length || !orientation.find_point(feet, limit, t, point)) continue;
    const Eigen::Vector3d centre = (limit[t[0]] + limit[t[1]] + limit[t[2]]) / 3;
    const double off = (centre - orientation.input().position(point)).squaredNorm();
    if (off > kFarShare * kFarShare * longest) stray.push_back(f);
  }
  return stray;
}

std::vector<std::uint32_t> corners_of(const relax::SubdividedLevel& finest,
                                      const std::vector<std::uint32_t>& faces) {
  std::vector<std::uint32_t> corners;
  for (std::uint32_t f : faces)
    corners.insert(corners.end(), finest.triangles[f].begin(), finest.triangles[f].end());
  std::ranges::sort(corners);
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  return corners;
}

void move_to_neighbours(const relax::SubdividedLevel& finest,
                        const std::vector<std::uint32_t>& vertices, Points& points) {
  constexpr std::uint32_t none = 0xffffffffu;
  struct Mean {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    int count = 0;
  };
  std::vector<std::uint32_t> slots(points.size(), none);
  for (std::uint32_t i = 0; i < vertices.size(); ++i) slots[vertices[i]] = i;
  std::vector<Mean> means(vertices.size());
  const auto add = [&](std::uint32_t to, std::uint32_t from) {
    if (slots[to] == none) return;
    means[slots[to]].sum += points[from];
    ++means[slots[to]].count;
  };
  for (const auto& [a, b] : finest.edges) {
    add(a, b);
    add(b, a);
  }
  for (std::size_t i = 0; i < vertices.size(); ++i)
    points[vertices[i]] += kStep * (means[i].sum / means[i].count - points[vertices[i]]);
}

}  // namespace

std::vector<std::uint32_t> find_long_faces(const relax::SubdividedLevel& finest,
                                           const Points& limit,
                                           const std::vector<std::uint32_t>& faces) {
  const double squared_length = kLong * kLong * mean_squared_edge(finest, limit);
  std::vector<std::uint32_t> found;
  for (std::uint32_t f : faces)
    if (longest_squared_edge(limit, finest.triangles[f]) >= squared_length) found.push_back(f);
  return found;
}

std::uint32_t draw_in_stray_faces(const InputOrientation& orientation,
                                  const relax::SubdividedLevel& finest, const LimitOperator& limit,
                                  std::vector<relax::SurfacePoint>& feet, Points& points) {
  const relax::InputSurface& input = orientation.input();
  Points at;
  limit.apply(points, at);
  const double squared_length = kLong * kLong * mean_squared_edge(finest, at);
  std::uint32_t found = 0;
  for (int round = 0; round < kRounds; ++round) {
    const std::vector<std::uint32_t> stray =
        find_stray(orientation, finest, feet, at, squared_length);
    if (round == 0) found = static_cast<std::uint32_t>(stray.size());
    if (stray.empty()) break;
    const std::vector<std::uint32_t> moved = corners_of(finest, stray);
    move_to_neighbours(finest, moved, points);
    limit.apply(points, at);
    for (std::uint32_t v : moved)
      if (!orientation.is_on_feature(feet[v]))
        feet[v] = relax::walk_on_surface(input, feet[v], at[v] - input.position(feet[v]));
  }
  return found;
}

}  // namespace zerotree::fit
