#include "discretisation/butterfly_subdivision.h"

#include <array>
#include <cmath>
#include <numbers>

#include "domain/feature_edges.h"
#include "domain/feature_vertices.h"

namespace zerotree::discretisation {
namespace {

using domain::kNext;
using domain::kNone;
using domain::kPrev;
using Eigen::Vector3d;

// Weight of the neighbour `j` steps around from the edge's other end, at a vertex of valence `k`.
double irregular_weight(int j, int k) {
  if (k == 3) return j == 0 ? 5.0 / 12 : -1.0 / 12;
  if (k == 4) return j == 0 ? 3.0 / 8 : j == 2 ? -1.0 / 8 : 0.0;
  const double angle = 2 * std::numbers::pi * j / k;
  return (0.25 + std::cos(angle) + 0.5 * std::cos(2 * angle)) / k;
}

}  // namespace

FeaturedMesh find_features(const TriangleMesh& mesh, double crease_angle_degrees) {
  FeaturedMesh featured{mesh, {}, {}};
  featured.topology =
      domain::build_topology(static_cast<std::uint32_t>(mesh.positions.size()), mesh.triangles);
  domain::tag_crease_edges(mesh, crease_angle_degrees, featured.topology);
  featured.kinds = domain::classify_vertices(mesh, featured.topology);
  return featured;
}

void ButterflyStencils::gather_spokes(std::uint32_t vertex) {
  domain::gather_star(input_.topology, vertex, star_);
  spokes_.clear();
  is_feature_.clear();
  features_ = 0;
  const auto add = [&](std::uint32_t face, int edge, std::uint32_t neighbour) {
    spokes_.push_back(neighbour);
    is_feature_.push_back(domain::is_feature(input_.topology, face, edge) ? 1 : 0);
    features_ += is_feature_.back();
  };
  for (const auto& [face, corner] : star_.corners)
    add(face, corner, input_.topology.faces[face][kNext[corner]]);
  if (star_.closed) return;
  const auto& [face, corner] = star_.corners.back();
  add(face, kPrev[corner], input_.topology.faces[face][kPrev[corner]]);
}

Vector3d ButterflyStencils::edge_point(std::uint32_t face, int k) {
  const Triangle& t = input_.topology.faces[face];
  const std::uint32_t a = t[k], b = t[kNext[k]];
  if (domain::is_feature(input_.topology, face, k)) return curve_point(a, b);
  const EndRule from_a = end_rule(a, b), from_b = end_rule(b, a);
  if (from_a.rank > from_b.rank) return from_a.point;
  if (from_b.rank > from_a.rank) return from_b.point;
  if (from_a.rank == Rank::regular) return regular_point(face, k);
  return (from_a.point + from_b.point) / 2;
}

// The neighbour of `vertex` along the feature that leads on to `next`; kNone if it begins here.
std::uint32_t ButterflyStencils::previous_on_curve(std::uint32_t vertex, std::uint32_t next) {
  if (input_.kinds[vertex] != domain::VertexKind::chain) return kNone;
  gather_spokes(vertex);
  for (std::size_t i = 0; i < spokes_.size(); ++i)
    if (is_feature_[i] != 0 && spokes_[i] != next) return spokes_[i];
  return kNone;
}

Vector3d ButterflyStencils::curve_point(std::uint32_t a, std::uint32_t b) {
  const std::uint32_t before = previous_on_curve(a, b), after = previous_on_curve(b, a);
  const Vector3d &p = position(a), &q = position(b);
  if (before == kNone && after == kNone) return (p + q) / 2;
  // A parabola through three points where the curve ends.
  if (before == kNone) return (3 * p + 6 * q - position(after)) / 8;
  if (after == kNone) return (3 * q + 6 * p - position(before)) / 8;
  return (9 * (p + q) - position(before) - position(after)) / 16;
}

ButterflyStencils::EndRule ButterflyStencils::end_rule(std::uint32_t vertex, std::uint32_t other) {
  gather_spokes(vertex);
  int spoke = 0;
  while (spokes_[spoke] != other) ++spoke;
  // A crease's end in a smooth region (a dart) is smooth.
  if (features_ >= 2) return {Rank::feature, sector_point(vertex, spoke)};
  if (spokes_.size() == 6) return {Rank::regular, Vector3d::Zero()};
  return {Rank::irregular, irregular_point(vertex, spoke)};
}

// The eight points of Butterfly.
Vector3d ButterflyStencils::regular_point(std::uint32_t face, int k) const {
  const domain::TriangleTopology& topology = input_.topology;
  Vector3d ends = Vector3d::Zero(), apices = Vector3d::Zero(), wings = Vector3d::Zero();
  const std::uint32_t across = topology.adjacent[face][k];
  const int back = domain::edge_towards(topology, across, face);
  for (const auto& [f, edge] : {domain::Corner{face, k}, domain::Corner{across, back}}) {
    ends += position(topology.faces[f][edge]);
    apices += position(topology.faces[f][kPrev[edge]]);
    for (int side : {kNext[edge], kPrev[edge]}) {
      const std::uint32_t wing = topology.adjacent[f][side];
      wings += position(topology.faces[wing][kPrev[domain::edge_towards(topology, wing, f)]]);
    }
  }
  return ends / 2 + apices / 8 - wings / 16;
}

Vector3d ButterflyStencils::irregular_point(std::uint32_t vertex, int spoke) const {
  const int k = static_cast<int>(spokes_.size());
  Vector3d sum = Vector3d::Zero();
  double weights = 0;
  for (int j = 0; j < k; ++j) {
    const double weight = irregular_weight(j, k);
    sum += weight * position(spokes_[(spoke + j) % k]);
    weights += weight;
  }
  return sum + (1 - weights) * position(vertex);
}

// The rule between two features: a half disc of k faces, whatever its angle.
Vector3d ButterflyStencils::sector_point(std::uint32_t vertex, int spoke) const {
  const int count = static_cast<int>(spokes_.size());
  const auto at = [&](int i) { return (i % count + count) % count; };
  int first = spoke, last = spoke;
  while (is_feature_[at(first)] == 0) --first;
  while (is_feature_[at(last)] == 0) ++last;
  const int k = last - first, i = spoke - first;
  const double theta = std::numbers::pi / k;
  const auto sine = [&](int j) { return std::sin(j * theta); };
  const double end_weight =
      std::cos(i * theta) / 4 -
      sine(2) * sine(2 * i) / (4 * k * (std::cos(theta) - std::cos(2 * theta)));
  Vector3d sum = (1 - sine(1) * sine(i) / (k * (1 - std::cos(theta)))) * position(vertex) +
                 end_weight * (position(spokes_[at(first)]) - position(spokes_[at(last)]));
  for (int j = 1; j < k; ++j)
    sum +=
        (sine(i) * sine(j) + sine(2 * i) * sine(2 * j) / 2) / k * position(spokes_[at(first + j)]);
  return sum;
}

FeaturedMesh butterfly_subdivide(const FeaturedMesh& input) {
  const domain::TriangleTopology& topology = input.topology;
  FeaturedMesh result;
  result.mesh.positions = input.mesh.positions;
  result.kinds = input.kinds;
  std::vector<std::array<std::uint32_t, 3>> middle(topology.faces.size());
  ButterflyStencils stencils(input);
  for (std::uint32_t f = 0; f < topology.faces.size(); ++f)
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t other = topology.adjacent[f][k];
      if (other != kNone && other < f) {
        middle[f][k] = middle[other][domain::edge_towards(topology, other, f)];
        continue;
      }
      middle[f][k] = static_cast<std::uint32_t>(result.mesh.positions.size());
      result.mesh.positions.push_back(stencils.edge_point(f, k));
      result.kinds.push_back(domain::is_feature(topology, f, k) ? domain::VertexKind::chain
                                                                : domain::VertexKind::smooth);
    }
  for (std::uint32_t f = 0; f < topology.faces.size(); ++f) {
    const Triangle& t = topology.faces[f];
    const auto& m = middle[f];
    for (int k = 0; k < 3; ++k) result.mesh.triangles.push_back({t[k], m[k], m[kPrev[k]]});
    result.mesh.triangles.push_back({m[0], m[1], m[2]});
  }
  result.topology = domain::build_topology(static_cast<std::uint32_t>(result.kinds.size()),
                                           result.mesh.triangles);
  // The corner face k has half of the edge k as its first edge and half of the one before as last.
  for (std::uint32_t f = 0; f < topology.faces.size(); ++f)
    for (int k = 0; k < 3; ++k) {
      const int own = (topology.creases[f] >> k) & 1,
                before = (topology.creases[f] >> kPrev[k]) & 1;
      result.topology.creases[4 * f + k] = static_cast<std::uint8_t>(own | (before << 2));
    }
  return result;
}

}  // namespace zerotree::discretisation
