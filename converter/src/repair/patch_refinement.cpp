#include "repair/patch_refinement.h"

#include <Eigen/Geometry>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace zerotree::repair {
namespace {

using Eigen::Vector3d;
using Edge = std::pair<std::uint32_t, std::uint32_t>;

// Liepa's density factor: a triangle is split where its corners are so much farther from its
// centroid than edges there are long.
constexpr double kDensity = 1.4142;
constexpr int kMostRounds = 12;
constexpr int kFlipSweeps = 6;
// A filling grows to so many points, whatever the rim's edges say.
constexpr std::size_t kMostPoints = 200'000;

Edge edge_of(std::uint32_t a, std::uint32_t b) {
  return std::minmax(a, b);
}

// The mean length of the rim's edges at each of its points.
std::vector<double> rim_scales(const Patch& patch) {
  std::vector<double> scales(patch.rim_size, 0.0);
  for (std::uint32_t i = 0; i < patch.rim_size; ++i) {
    const std::uint32_t j = (i + 1) % patch.rim_size;
    const double length = (patch.points[i] - patch.points[j]).norm();
    scales[i] += length / 2;
    scales[j] += length / 2;
  }
  return scales;
}

bool split_large_triangles(Patch& patch, std::vector<double>& scales) {
  bool changed = false;
  const std::size_t count = patch.triangles.size();
  for (std::size_t f = 0; f < count && patch.points.size() < kMostPoints; ++f) {
    const Triangle t = patch.triangles[f];
    const Vector3d centre = (patch.points[t[0]] + patch.points[t[1]] + patch.points[t[2]]) / 3;
    const double scale = (scales[t[0]] + scales[t[1]] + scales[t[2]]) / 3;
    const bool is_large = std::ranges::all_of(t, [&](std::uint32_t v) {
      return kDensity * (centre - patch.points[v]).norm() > std::max(scale, scales[v]);
    });
    if (!is_large) continue;
    const auto middle = static_cast<std::uint32_t>(patch.points.size());
    patch.points.push_back(centre);
    scales.push_back(scale);
    patch.triangles[f] = {t[0], t[1], middle};
    patch.triangles.push_back({t[1], t[2], middle});
    patch.triangles.push_back({t[2], t[0], middle});
    changed = true;
  }
  return changed;
}

double angle_at(const Patch& patch, std::uint32_t apex, std::uint32_t a, std::uint32_t b) {
  const Vector3d p = patch.points[a] - patch.points[apex], q = patch.points[b] - patch.points[apex];
  return std::atan2(p.cross(q).norm(), p.dot(q));
}

// Corner of `t` opposite its edge between `a` and `b`.
std::uint32_t apex_of(const Triangle& t, std::uint32_t a, std::uint32_t b) {
  for (std::uint32_t v : t)
    if (v != a && v != b) return v;
  return t[0];
}

// Flips edges whose opposite angles are more than two right ones. Each sweep flips each triangle
// once at most.
bool flip_towards_delaunay(Patch& patch,
                           const std::function<bool(std::uint32_t, std::uint32_t)>& may_connect) {
  std::map<Edge, std::array<std::uint32_t, 2>> faces;
  for (std::uint32_t f = 0; f < patch.triangles.size(); ++f)
    for (int k = 0; k < 3; ++k) {
      const Triangle& t = patch.triangles[f];
      auto [place, is_new] = faces.try_emplace(edge_of(t[k], t[(k + 1) % 3]),
                                               std::array<std::uint32_t, 2>{f, 0xffffffffu});
      if (!is_new) place->second[1] = f;
    }
  std::set<Edge> made;
  std::vector<std::uint8_t> touched(patch.triangles.size(), 0);
  for (const auto& [edge, sides] : faces) {
    const auto [f, g] = sides;
    if (g == 0xffffffffu || touched[f] != 0 || touched[g] != 0) continue;
    const auto [a, b] = edge;
    const std::uint32_t p = apex_of(patch.triangles[f], a, b),
                        q = apex_of(patch.triangles[g], a, b);
    constexpr double straight = 3.14159265 + 1e-6;
    if (angle_at(patch, p, a, b) + angle_at(patch, q, a, b) <= straight) continue;
    const Edge flipped = edge_of(p, q);
    if (p == q || faces.contains(flipped) || made.contains(flipped)) continue;
    if (p < patch.rim_size && q < patch.rim_size && !may_connect(p, q)) continue;
    // `f` runs from a to b or back.
    const Triangle& t = patch.triangles[f];
    const auto at = std::ranges::find(t, a) - t.begin();
    const bool forward = t[(at + 1) % 3] == b;
    patch.triangles[f] = forward ? Triangle{p, a, q} : Triangle{p, q, a};
    patch.triangles[g] = forward ? Triangle{q, b, p} : Triangle{q, p, b};
    touched[f] = touched[g] = 1;
    made.insert(flipped);
  }
  return !made.empty();
}

}  // namespace

void refine_patch(Patch& patch,
                  const std::function<bool(std::uint32_t, std::uint32_t)>& may_connect) {
  std::vector<double> scales = rim_scales(patch);
  for (int round = 0; round < kMostRounds; ++round) {
    if (!split_large_triangles(patch, scales)) return;
    for (int sweep = 0; sweep < kFlipSweeps; ++sweep)
      if (!flip_towards_delaunay(patch, may_connect)) break;
  }
}

void smooth_patch(Patch& patch, const std::vector<std::vector<Vector3d>>& outside) {
  const auto count = static_cast<std::uint32_t>(patch.points.size());
  const std::uint32_t fixed = patch.rim_size;
  if (count == fixed) return;
  std::vector<std::set<std::uint32_t>> neighbours(count);
  for (const Triangle& t : patch.triangles)
    for (int k = 0; k < 3; ++k) {
      neighbours[t[k]].insert(t[(k + 1) % 3]);
      neighbours[t[(k + 1) % 3]].insert(t[k]);
    }
  // A row for each point: its degree times itself less its neighbours; what is fixed on the right.
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::MatrixX3d right = Eigen::MatrixX3d::Zero(count, 3);
  for (std::uint32_t v = 0; v < count; ++v) {
    const auto add = [&](std::uint32_t w, double weight) {
      if (w < fixed)
        right.row(v) -= weight * patch.points[w].transpose();
      else
        entries.emplace_back(v, w - fixed, weight);
    };
    double degree = static_cast<double>(neighbours[v].size());
    for (std::uint32_t w : neighbours[v]) add(w, -1);
    if (v < fixed) {
      degree += static_cast<double>(outside[v].size());
      for (const Vector3d& p : outside[v]) right.row(v) += p.transpose();
    }
    add(v, degree);
  }
  Eigen::SparseMatrix<double> rows(count, count - fixed);
  rows.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SparseMatrix<double> normal = rows.transpose() * rows;
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(normal);
  if (solver.info() != Eigen::Success) return;
  const Eigen::MatrixX3d solution = solver.solve(rows.transpose() * right);
  if (!solution.allFinite()) return;
  for (std::uint32_t v = fixed; v < count; ++v)
    patch.points[v] = solution.row(v - fixed).transpose();
}

}  // namespace zerotree::repair
