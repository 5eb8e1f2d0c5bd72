#include "domain/collapse_cost.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace zerotree::domain {
namespace {

// Share of (area x squared edge length) in the cost: spreads the base over flat regions.
constexpr double kAreaTerm = 2e-3;
// Slivers beyond this aspect are all equally bad.
constexpr double kMaxAspect = 100.0;
// Cost factor e^this for each face above valence 6 and, twice, for each below 5.
constexpr double kValenceWeight = 0.4;

double valence_excess(int valence) {
  return std::max(0, valence - 6) + 2.0 * std::max(0, 5 - valence);
}

// 1 for an equilateral triangle, growing with its elongation.
double aspect_of(double squared_edges, double area) {
  constexpr double equilateral = 4.0 * std::numbers::sqrt3;
  return squared_edges < kMaxAspect * equilateral * area ? squared_edges / (equilateral * area)
                                                         : kMaxAspect;
}

}  // namespace

std::vector<Eigen::Vector3d> normalised_positions(const TriangleMesh& mesh) {
  Eigen::Vector3d low = mesh.positions.front(), high = mesh.positions.front();
  for (const Eigen::Vector3d& p : mesh.positions) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const Eigen::Vector3d centre = low + (high - low) / 2;
  const double diagonal = (high - low).stableNorm();
  const double scale = diagonal > 0 ? 1.0 / diagonal : 1.0;
  std::vector<Eigen::Vector3d> positions;
  positions.reserve(mesh.positions.size());
  for (const Eigen::Vector3d& p : mesh.positions) positions.push_back((p - centre) * scale);
  return positions;
}

std::vector<Quadric> vertex_quadrics(const TriangleTopology& topology,
                                     const std::vector<std::uint8_t>& gone,
                                     const std::vector<Eigen::Vector3d>& positions) {
  std::vector<Quadric> quadrics(positions.size());
  for (std::uint32_t f = 0; f < topology.faces.size(); ++f) {
    if (gone[f]) continue;
    const Triangle& t = topology.faces[f];
    const Eigen::Vector3d cross =
        (positions[t[1]] - positions[t[0]]).cross(positions[t[2]] - positions[t[0]]);
    const double area = cross.norm() / 2;
    const Eigen::Vector3d normal = cross.stableNormalized();
    for (std::uint32_t v : t) quadrics[v].add_plane(normal, positions[t[0]], area / 3);
    for (int k = 0; k < 3; ++k) {
      if (topology.adjacent[f][k] != kNone) continue;
      const Eigen::Vector3d& p = positions[t[k]];
      const Eigen::Vector3d edge = positions[t[kNext[k]]] - p;
      const Eigen::Vector3d upright = edge.cross(normal).stableNormalized();
      for (std::uint32_t v : {t[k], t[kNext[k]]})
        quadrics[v].add_plane(upright, p, edge.squaredNorm() / 2);
    }
  }
  return quadrics;
}

double collapse_cost(const TriangleTopology& topology,
                     const std::vector<Eigen::Vector3d>& positions,
                     const std::vector<Quadric>& quadrics, const Star& star,
                     const CollapseSite& site, bool forbid_flips) {
  const Eigen::Vector3d& from = positions[site.removed];
  const Eigen::Vector3d& to = positions[site.kept];
  double area = 0, aspect = 1, turn = 1;
  for (const auto& [face, corner] : star.corners) {
    if (face == site.left || face == site.right) continue;
    const Eigen::Vector3d& p = positions[topology.faces[face][kNext[corner]]];
    const Eigen::Vector3d& q = positions[topology.faces[face][kPrev[corner]]];
    const Eigen::Vector3d before = (p - from).cross(q - from), after = (p - to).cross(q - to);
    const double size_before = before.norm(), size_after = after.norm();
    const double cosine = before.dot(after);
    if (forbid_flips && cosine < 0.1 * size_before * size_after)
      return std::numeric_limits<double>::infinity();
    turn = std::min(turn, cosine / std::max(size_before * size_after, 1e-300));
    area += size_after / 2;
    const double edges = (p - to).squaredNorm() + (q - to).squaredNorm() + (p - q).squaredNorm();
    aspect = std::max(aspect, aspect_of(edges, size_after / 2));
  }
  double excess = valence_excess(site.kept_valence);
  if (site.left_apex != kNone) excess += 2.0 * std::max(0, 5 - site.left_apex_valence);
  if (site.right_apex != kNone) excess += 2.0 * std::max(0, 5 - site.right_apex_valence);
  const double distance = quadrics[site.removed].at(to) + quadrics[site.kept].at(to);
  return (distance + kAreaTerm * area * (to - from).squaredNorm()) * aspect * (2.0 - turn) *
         std::exp(kValenceWeight * excess);
}

}  // namespace zerotree::domain
