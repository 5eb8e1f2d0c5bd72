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
double limb_distance(const Quadric& quadric, double value, double patch_area) {
  return value * (1 + kLimbShare * patch_area / std::max(quadric.weight(), 1e-30));
}

// 1 for an equilateral triangle, growing with its elongation.
double aspect_of(double squared_edges, double area) {
  constexpr double equilateral = 4.0 * std::numbers::sqrt3;
  return squared_edges < kMaxAspect * equilateral * area ? squared_edges / (equilateral * area)
                                                         : kMaxAspect;
}

}  // namespace

std::vector<Eigen::Vector3f> normalised_positions(const TriangleMesh& mesh) {
  Eigen::Vector3d low = mesh.positions.front(), high = mesh.positions.front();
  for (const Eigen::Vector3d& p : mesh.positions) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const Eigen::Vector3d centre = low + (high - low) / 2;
  const double diagonal = (high - low).stableNorm();
  const double scale = diagonal > 0 ? 1.0 / diagonal : 1.0;
  std::vector<Eigen::Vector3f> positions;
  positions.reserve(mesh.positions.size());
  for (const Eigen::Vector3d& p : mesh.positions)
    positions.push_back(((p - centre) * scale).cast<float>());
  return positions;
}

std::vector<Quadric> vertex_quadrics(const TriangleTopology& topology,
                                     const std::vector<std::uint8_t>& gone,
                                     const std::vector<Eigen::Vector3f>& positions) {
  std::vector<Quadric> quadrics(positions.size());
  for (std::uint32_t f = 0; f < topology.faces.size(); ++f) {
    if (gone[f]) continue;
    const Triangle& t = topology.faces[f];
    const auto side = [&](int from, int to) -> Eigen::Vector3d {
      return (positions[t[to]] - positions[t[from]]).cast<double>();
    };
    const Eigen::Vector3d cross = side(0, 1).cross(side(0, 2));
    const double area = cross.norm() / 2;
    const Eigen::Vector3d normal = cross.stableNormalized();
    for (std::uint32_t v : t) quadrics[v].add_plane(normal, area / 3);
    for (int k = 0; k < 3; ++k) {
      if (topology.adjacent[f][k] != kNone) continue;
      const Eigen::Vector3d edge = side(k, kNext[k]);
      const Eigen::Vector3d upright = edge.cross(normal).stableNormalized();
      for (std::uint32_t v : {t[k], t[kNext[k]]})
        quadrics[v].add_plane(upright, edge.squaredNorm() / 2);
    }
  }
  return quadrics;
}

void CollapseCost::visit(const TriangleTopology& topology, const Star& star) {
  sides_.clear();
  for (const auto& [face, corner] : star.corners) {
    const Triangle& corners = topology.faces[face];
    const Eigen::Vector3d from = positions_[corners[corner]].cast<double>();
    Side& side = sides_.emplace_back();
    side.face = face;
    side.p = positions_[corners[kNext[corner]]].cast<double>();
    side.q = positions_[corners[kPrev[corner]]].cast<double>();
    side.area = (side.p - from).cross(side.q - from);
    side.size = side.area.norm();
    side.squared_length = (side.p - side.q).squaredNorm();
  }
}

double CollapseCost::distance(const CollapseSite& site) const {
  const Quadric &removed = quadrics_[site.removed], &kept = quadrics_[site.kept];
  const Eigen::Vector3d way = (positions_[site.kept] - positions_[site.removed]).cast<double>();
  return limb_distance(removed, removed.at(way), patch_area_) +
         limb_distance(kept, kept.c, patch_area_);
}

double CollapseCost::lower_bound(const CollapseSite& site) const {
  return distance(site) * valence_factor(site);
}

double CollapseCost::of(const CollapseSite& site, const CollapseCaps& caps) const {
  const Eigen::Vector3d to = positions_[site.kept].cast<double>();
  double area = 0, aspect = 1, turn = 1;
  for (const Side& side : sides_) {
    if (side.face == site.left || side.face == site.right) continue;
    const Eigen::Vector3d to_p = side.p - to, to_q = side.q - to, after = to_p.cross(to_q);
    const double size = after.norm(), cosine = side.area.dot(after), sizes = side.size * size;
    if (caps.forbid_flips && cosine < 0.1 * sizes) return std::numeric_limits<double>::infinity();
    turn = std::min(turn, cosine / std::max(sizes, 1e-300));
    area += size / 2;
    const double edges = to_p.squaredNorm() + to_q.squaredNorm() + side.squared_length;
    aspect = std::max(aspect, aspect_of(edges, size / 2));
  }
  const double length =
      (positions_[site.kept] - positions_[site.removed]).cast<double>().squaredNorm();
  return (distance(site) + kAreaTerm * area * length) * aspect * (2.0 - turn) *
         valence_factor(site);
}

}  // namespace zerotree::domain
