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
// Share of a patch's area that a quadric counts besides its own.
constexpr double kLimbShare = 0.1;
// Cost factor e^this for each face above valence 6 and, twice, for each below 5.
constexpr double kValenceWeight = 0.4;

// e^(kValenceWeight x excess), 1 for a regular site.
double valence_factor(const CollapseSite& site) {
  int excess = std::max(0, site.kept_valence - 6) + 2 * std::max(0, 5 - site.kept_valence);
  if (site.left_apex != kNone) excess += 2 * std::max(0, 5 - site.left_apex_valence);
  if (site.right_apex != kNone) excess += 2 * std::max(0, 5 - site.right_apex_valence);
  return excess == 0 ? 1.0 : std::exp(kValenceWeight * excess);
}

// The quadric's squared distance times its area and a share of a patch's.
double limb_distance(const Quadric& quadric, const Eigen::Vector3d& to, double patch_area) {
  return quadric.at(to) * (1 + kLimbShare * patch_area / std::max(quadric.weight(), 1e-300));
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

void CollapseCost::visit(const TriangleTopology& topology, const Star& star) {
  sides_.clear();
  for (const auto& [face, corner] : star.corners) {
    const Triangle& corners = topology.faces[face];
    const Eigen::Vector3d& from = positions_[corners[corner]];
    Side& side = sides_.emplace_back();
    side.face = face;
    side.p = positions_[corners[kNext[corner]]];
    side.q = positions_[corners[kPrev[corner]]];
    side.area = (side.p - from).cross(side.q - from);
    side.size = side.area.norm();
    side.squared_length = (side.p - side.q).squaredNorm();
  }
}

double CollapseCost::of(const CollapseSite& site, const CollapseCaps& caps, double limit) const {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  const Eigen::Vector3d& to = positions_[site.kept];
  const double distance = limb_distance(quadrics_[site.removed], to, patch_area_) +
                          limb_distance(quadrics_[site.kept], to, patch_area_);
  const double factor = valence_factor(site);
  if (distance * factor > limit) return infinite;
  double area = 0, aspect = 1, turn = 1;
  for (const Side& side : sides_) {
    if (side.face == site.left || side.face == site.right) continue;
    const Eigen::Vector3d to_p = side.p - to, to_q = side.q - to, after = to_p.cross(to_q);
    const double size = after.norm(), cosine = side.area.dot(after), sizes = side.size * size;
    if (caps.forbid_flips && cosine < 0.1 * sizes) return infinite;
    turn = std::min(turn, cosine / std::max(sizes, 1e-300));
    area += size / 2;
    const double edges = to_p.squaredNorm() + to_q.squaredNorm() + side.squared_length;
    aspect = std::max(aspect, aspect_of(edges, size / 2));
  }
  const double length = (to - positions_[site.removed]).squaredNorm();
  return (distance + kAreaTerm * area * length) * aspect * (2.0 - turn) * factor;
}

}  // namespace zerotree::domain
