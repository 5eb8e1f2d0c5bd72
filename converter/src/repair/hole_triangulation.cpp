#include "repair/hole_triangulation.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <queue>
#include <tuple>

namespace zerotree::repair {
namespace {

using Eigen::Vector3d;

constexpr std::size_t kMostForBest = 200;
constexpr std::uint32_t kNoPoint = 0xffffffffu;

// Worst fold as 1 - cosine of the dihedral angle, then area.
using Cost = std::tuple<double, double>;
constexpr double kImpossible = std::numeric_limits<double>::infinity();

Vector3d normal_of(const Rim& rim, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  return (rim.points[b] - rim.points[a]).cross(rim.points[c] - rim.points[a]);
}

// Dynamic programming over the sub-polygons i, i + 1, ..., j.
class BestTriangulation {
 public:
  explicit BestTriangulation(const Rim& rim)
      : rim_(rim),
        n_(static_cast<std::uint32_t>(rim.points.size())),
        cost_(n_ * n_, Cost{0, 0}),
        apex_(n_ * n_, kNoPoint) {}

  std::vector<Triangle> run() {
    for (std::uint32_t span = 2; span < n_; ++span)
      for (std::uint32_t i = 0; i + span < n_; ++i) solve(i, i + span);
    std::vector<Triangle> triangles;
    if (std::get<0>(cost_[n_ - 1]) < kImpossible) collect(0, n_ - 1, triangles);
    return triangles;
  }

 private:
  Cost& cost(std::uint32_t i, std::uint32_t j) { return cost_[i * n_ + j]; }

  void solve(std::uint32_t i, std::uint32_t j) {
    cost(i, j) = {kImpossible, kImpossible};
    const bool is_rim = i == 0 && j == n_ - 1;
    if (!is_rim && !rim_.may_connect(i, j)) return;
    for (std::uint32_t m = i + 1; m < j; ++m) {
      const Vector3d normal = normal_of(rim_, i, m, j);
      const Vector3d unit = normal.stableNormalized();
      double fold = std::max(fold_at(i, m, unit), fold_at(m, j, unit));
      if (is_rim) fold = std::max(fold, 1 - unit.dot(rim_.normals_beyond[j]));
      const auto& [fold_left, area_left] = cost(i, m);
      const auto& [fold_right, area_right] = cost(m, j);
      const Cost total{std::max({fold, fold_left, fold_right}),
                       area_left + area_right + normal.norm() / 2};
      if (total >= cost(i, j)) continue;
      cost(i, j) = total;
      apex_[i * n_ + j] = m;
    }
  }

  // Between a triangle and what lies beyond its edge (i, j): the mesh or the triangle chosen there.
  double fold_at(std::uint32_t i, std::uint32_t j, const Vector3d& unit) const {
    if (j == i + 1) return 1 - unit.dot(rim_.normals_beyond[i]);
    const std::uint32_t m = apex_[i * n_ + j];
    if (m == kNoPoint) return kImpossible;
    return 1 - unit.dot(normal_of(rim_, i, m, j).stableNormalized());
  }

  void collect(std::uint32_t i, std::uint32_t j, std::vector<Triangle>& triangles) const {
    std::vector<std::array<std::uint32_t, 2>> stack{{i, j}};
    while (!stack.empty()) {
      const auto [a, b] = stack.back();
      stack.pop_back();
      if (b == a + 1) continue;
      const std::uint32_t m = apex_[a * n_ + b];
      triangles.push_back({a, m, b});
      stack.push_back({m, b});
      stack.push_back({a, m});
    }
  }

  const Rim& rim_;
  const std::uint32_t n_;
  std::vector<Cost> cost_;
  std::vector<std::uint32_t> apex_;
};

std::vector<Triangle> cut_ears(const Rim& rim) {
  const auto n = static_cast<std::uint32_t>(rim.points.size());
  std::vector<std::uint32_t> next(n), previous(n), version(n, 0);
  using Ear = std::tuple<double, std::uint32_t, std::uint32_t>;  // length, point, version
  std::priority_queue<Ear, std::vector<Ear>, std::greater<>> ears;
  const auto push = [&](std::uint32_t v) {
    ears.emplace((rim.points[previous[v]] - rim.points[next[v]]).norm(), v, ++version[v]);
  };
  for (std::uint32_t v = 0; v < n; ++v) {
    next[v] = (v + 1) % n;
    previous[v] = (v + n - 1) % n;
  }
  for (std::uint32_t v = 0; v < n; ++v) push(v);
  std::vector<Triangle> triangles;
  std::uint32_t left = n;
  while (!ears.empty() && left >= 3) {
    const auto [length, v, made] = ears.top();
    ears.pop();
    if (made != version[v]) continue;
    const std::uint32_t a = previous[v], b = next[v];
    if (left > 3 && !rim.may_connect(a, b)) continue;
    triangles.push_back({a, v, b});
    next[a] = b;
    previous[b] = a;
    version[v] = kNoPoint;
    if (--left < 3) break;
    push(a);
    push(b);
  }
  if (left >= 3) triangles.clear();
  return triangles;
}

}  // namespace

std::vector<Triangle> triangulate_rim(const Rim& rim) {
  if (rim.points.size() <= kMostForBest) return BestTriangulation(rim).run();
  return cut_ears(rim);
}

}  // namespace zerotree::repair
