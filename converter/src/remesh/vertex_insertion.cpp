#include "remesh/vertex_insertion.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mesh/error.h"

namespace zerotree::remesh {
namespace {

constexpr int kNewtonSteps = 3;
// A first guess is good if no triangle has less than this share of the mean area.
constexpr double kGoodShare = 0.02;
// Faces lower than this are within reach of rounding, which moves points by 2e-16 (a base edge is
// 1). Small faces are not: where a handle is squeezed they get down to an area of 1e-18.
constexpr double kLeastHeight = 4e-15;

double ring_area(const Ring& ring, const Eigen::Vector2d& p) {
  double sum = 0;
  for (std::size_t i = 0; i < ring.edge_count(); ++i)
    sum += doubled_area(p, ring.points[i], ring.points[ring.after(i)]);
  return sum;
}

}  // namespace

bool VertexInsertion::insert(ConeCharts& charts, const domain::CollapseRecord& collapse) {
  domain::undo_collapse(charts.topology, collapse, fan_);
  const auto [removed, kept, left, right] = collapse;
  charts.vertices[removed] = charts.vertices[kept];
  sector_.free = removed;
  sector_.fixed = kept;
  sector_.first_gap = left;
  sector_.last_gap = right;
  sector_.faces.clear();
  for (std::uint32_t face : fan_)
    sector_.faces.push_back({face, domain::corner_of(charts.topology.faces[face], removed)});
  unfold(charts);
  return place(charts);
}

bool VertexInsertion::swap_in(ConeCharts& charts, const domain::CollapseRecord& collapse) {
  const std::uint32_t removed = collapse.removed;
  if (!may_swap(charts, collapse)) return false;
  gather_complement(charts, collapse);
  if (sector_.faces.empty()) return false;
  unfold(charts);
  const std::uint32_t cone = charts.vertices[removed].cone;
  if (!place(charts)) return false;
  base_.mesh_vertex[cone] = removed;
  ++cone_swaps_;
  return true;
}

// A smooth cone may swap with a smooth vertex; a cone on a crease or boundary with a vertex of the
// same chain. A corner of the boundary may move by one vertex; a junction of creases never.
bool VertexInsertion::may_swap(const ConeCharts& charts, const domain::CollapseRecord& collapse) {
  using domain::VertexKind;
  if (charts.vertices[collapse.removed].cone == kNone) return false;
  const VertexKind kind = kinds_[collapse.kept];
  if (kind != VertexKind::corner) return kind == kinds_[collapse.removed];
  if (kinds_[collapse.removed] != VertexKind::chain) return false;
  domain::gather_star(charts.topology, collapse.kept, star_);
  int features = star_.closed ? 0 : 1;
  for (const auto& [face, corner] : star_.corners)
    features += domain::is_feature(charts.topology, face, kPrev[corner]) ? 1 : 0;
  return features == 2 && !star_.closed;
}

// The faces around `kept` other than the two of its edge to `removed`.
void VertexInsertion::gather_complement(const ConeCharts& charts,
                                        const domain::CollapseRecord& collapse) {
  sector_.free = collapse.kept;
  sector_.fixed = collapse.removed;
  sector_.first_gap = collapse.right;
  sector_.last_gap = collapse.left;
  sector_.faces.clear();
  domain::gather_star(charts.topology, collapse.kept, star_);
  const std::size_t n = star_.corners.size();
  std::size_t first = 0;
  if (collapse.right != kNone)
    while (star_.corners[first].face != collapse.right) ++first;
  for (std::size_t i = 0; i < n; ++i) {
    const domain::Corner& at = star_.corners[(first + i) % n];
    if (at.face != collapse.left && at.face != collapse.right) sector_.faces.push_back(at);
  }
}

// Lays the sector's faces out in the chart of the first: the ring of the free vertex.
void VertexInsertion::unfold(const ConeCharts& charts) {
  sector_.charts.assign(1, LatticeIsometry{});
  for (std::size_t i = 1; i < sector_.faces.size(); ++i) {
    const auto& [face, corner] = sector_.faces[i - 1];
    sector_.charts.push_back(
        compose(sector_.charts.back(), face_transition(charts, face, kPrev[corner])));
  }
  const auto& topology = charts.topology;
  ring_.closed = sector_.first_gap != kNone && sector_.last_gap != kNone;
  ring_.positions.clear();
  ring_lattice_.clear();
  sector_.chain = kNone;
  const auto add = [&](std::uint32_t vertex, const LatticePoint& point) {
    ring_.positions.push_back(positions_[vertex]);
    ring_lattice_.push_back(point);
  };
  const auto& [start, at] = sector_.faces.front();
  const LatticePoint fixed_point = charts.corner_point(start, at);
  if (sector_.first_gap != kNone) add(sector_.fixed, fixed_point);
  if (domain::is_feature(topology, start, at)) sector_.chain = ring_lattice_.size();
  add(topology.faces[start][kNext[at]], charts.corner_point(start, kNext[at]));
  for (std::size_t i = 0; i < sector_.faces.size(); ++i) {
    const auto& [face, corner] = sector_.faces[i];
    const int k = kPrev[corner];
    if (domain::is_feature(topology, face, k)) sector_.chain = ring_lattice_.size();
    add(topology.faces[face][k], apply(sector_.charts[i], charts.corner_point(face, k)));
  }
  if (sector_.first_gap == kNone) add(sector_.fixed, fixed_point);

  ring_.points.clear();
  for (const LatticePoint& point : ring_lattice_) ring_.points.push_back(to_plane(point));
  // Around a cone only can the sector fill a whole turn.
  sector_.angle = 0;
  if (charts.vertices[sector_.fixed].cone == kNone) return;
  const Eigen::Vector2d centre = to_plane(fixed_point);
  const std::size_t first = sector_.first_gap != kNone ? 1 : 0;
  for (std::size_t i = first; i < first + sector_.faces.size(); ++i) {
    const Eigen::Vector2d a = ring_.points[i] - centre, b = ring_.points[i + 1] - centre;
    sector_.angle += std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
  }
}

bool VertexInsertion::place(ConeCharts& charts) {
  const VertexChart chart_before = charts.vertices[sector_.free];
  std::vector<LatticeIsometry>& before = transitions_before_;
  before.clear();
  for (const auto& [face, corner] : sector_.faces)
    before.push_back(charts.transitions[face][corner]);
  energy_.prepare(ring_, positions_[sector_.free]);
  const bool smooth = kinds_[sector_.free] == domain::VertexKind::smooth;
  const bool placed = smooth ? place_in_plane(charts) : place_on_chain(charts);
  if (placed && is_positive(charts, sector_.free)) return true;
  charts.vertices[sector_.free] = chart_before;
  for (std::size_t i = 0; i < before.size(); ++i)
    charts.transitions[sector_.faces[i].face][sector_.faces[i].corner] = before[i];
  return false;
}

bool VertexInsertion::place_in_plane(ConeCharts& charts) {
  if (sector_.angle >= 2 * std::numbers::pi - 1e-6) return false;
  Eigen::Vector2d p = mean_value_average(ring_, positions_[sector_.free]);
  const double good = kGoodShare * ring_area(ring_, p) / static_cast<double>(ring_.edge_count());
  const double least = least_doubled_area(ring_, p);
  if (!(least > 0) || least < good) {
    const auto centroid = kernel_centroid(ring_);
    const bool usable = centroid && least_doubled_area(ring_, *centroid) > 0;
    if (!usable && !(least > 0)) return false;
    if (usable && energy_.energy(*centroid) < energy_.energy(p)) p = *centroid;
  }
  p = minimise_in_plane(energy_, ring_, p, kNewtonSteps);

  const FaceAnchor anchor = anchor_of(charts, base_, sector_.faces.front().face);
  const BasePlace place =
      walk(base_, anchor.triangle, anchor.point, apply(anchor.map, to_lattice(p)));
  set_transitions(charts, inverse(compose(place.map, anchor.map)));
  charts.vertices[sector_.free] = {place.point, place.triangle, kNone, 0};
  return true;
}

bool VertexInsertion::place_on_chain(ConeCharts& charts) {
  if (sector_.chain == kNone) return false;
  const std::size_t fixed = sector_.first_gap != kNone ? 0 : ring_.points.size() - 1;
  const Eigen::Vector2d &a = ring_.points[fixed], &b = ring_.points[sector_.chain];
  const auto interval = kernel_interval(ring_, a, b);
  if (!interval) return false;
  const auto [low, high] = *interval;
  const Eigen::Vector3d& here = positions_[sector_.free];
  const double before = (here - ring_.positions[fixed]).norm();
  const double after = (here - ring_.positions[sector_.chain]).norm();
  const double guess = before + after > 0 ? before / (before + after) : 0.5;
  const double margin = 0.05 * (high - low);
  const double s = minimise_on_line(energy_, ring_, a, b,
                                    std::clamp(guess, low + margin, high - margin), kNewtonSteps);

  VertexChart vertex;
  double t_fixed = 0, t_chain = 1;
  const LatticeIsometry from_vertex = chain_chart(charts, vertex, t_fixed, t_chain);
  vertex.point = {t_fixed + s * (t_chain - t_fixed), 0};
  if (!(vertex.point.x() > 0 && vertex.point.x() < 1)) return false;
  set_transitions(charts, from_vertex);
  charts.vertices[sector_.free] = vertex;
  return true;
}

// The chart in which the chain through the free vertex is the base edge from (0,0) to (1,0): the
// map from it to the first face's chart, and where its two chain neighbours lie.
LatticeIsometry VertexInsertion::chain_chart(const ConeCharts& charts, VertexChart& vertex,
                                             double& t_fixed, double& t_chain) const {
  const auto& [start, at] = sector_.faces.front();
  const std::size_t first_x = sector_.first_gap != kNone ? 1 : 0;
  // The chain neighbour as a corner of one of the sector's faces.
  const std::size_t x = sector_.chain - first_x;
  const std::size_t index = x == 0 ? 0 : x - 1;
  const domain::Corner& beside = sector_.faces[index];
  const int k = x == 0 ? kNext[beside.corner] : kPrev[beside.corner];
  const LatticeIsometry to_end = compose(sector_.charts[index], charts.transitions[beside.face][k]);
  const VertexChart& end = charts.vertices[charts.topology.faces[beside.face][k]];
  const VertexChart& fixed = charts.vertices[sector_.fixed];
  t_fixed = fixed.point.x();
  t_chain = end.point.x();
  const auto end_of_edge = [&](std::uint32_t cone) {
    const Triangle& corners = base_.topology.triangles[vertex.triangle];
    return corners[vertex.corner] == cone ? 0.0 : 1.0;
  };
  if (fixed.cone == kNone) {
    vertex = fixed;
    if (end.cone != kNone) t_chain = end_of_edge(end.cone);
    return charts.transitions[start][at];
  }
  if (end.cone == kNone) {
    vertex = end;
    t_fixed = end_of_edge(fixed.cone);
    return to_end;
  }
  // Between two cones: the base edge itself, which runs one way or the other.
  const LatticeIsometry& to_fixed = charts.transitions[start][at];
  for (std::uint32_t f = 0; f < base_.topology.triangles.size(); ++f)
    for (int edge = 0; edge < 3; ++edge) {
      const Triangle& corners = base_.topology.triangles[f];
      const bool forward = corners[edge] == fixed.cone && corners[kNext[edge]] == end.cone;
      const bool backward = corners[edge] == end.cone && corners[kNext[edge]] == fixed.cone;
      if (!forward && !backward) continue;
      vertex = {{0, 0}, f, kNone, static_cast<std::uint8_t>(edge)};
      t_fixed = forward ? 0 : 1;
      t_chain = forward ? 1 : 0;
      const LatticeIsometry &origin = forward ? to_fixed : to_end,
                            &unit = forward ? to_end : to_fixed;
      for (std::int16_t turns = 0; turns < 6; ++turns) {
        const LatticeIsometry map{origin.dx, origin.dy, turns};
        if (apply(map, {1, 0}) == LatticePoint(unit.dx, unit.dy)) return map;
      }
    }
  throw Error(ExitCode::internal, "parameterisation: a feature has left its base edge");
}

// Gives every face around the free vertex its transition; `from_vertex` maps to the first face's
// chart. The two faces of the new edge take on the charts of their neighbours in the sector.
void VertexInsertion::set_transitions(ConeCharts& charts, const LatticeIsometry& from_vertex) {
  const auto fill_gap = [&](std::uint32_t gap, std::size_t index, bool is_first) {
    if (gap == kNone) return;
    const auto& [face, corner] = sector_.faces[index];
    const int k = is_first ? kNext[corner] : kPrev[corner];
    const Triangle& corners = charts.topology.faces[gap];
    auto& transitions = charts.transitions[gap];
    transitions[domain::corner_of(corners, sector_.fixed)] = charts.transitions[face][corner];
    transitions[domain::corner_of(corners, charts.topology.faces[face][k])] =
        charts.transitions[face][k];
    transitions[domain::corner_of(corners, sector_.free)] =
        compose(inverse(sector_.charts[index]), from_vertex);
  };
  fill_gap(sector_.first_gap, 0, true);
  fill_gap(sector_.last_gap, sector_.faces.size() - 1, false);
  for (std::size_t i = 0; i < sector_.faces.size(); ++i) {
    const auto& [face, corner] = sector_.faces[i];
    charts.transitions[face][corner] = compose(inverse(sector_.charts[i]), from_vertex);
  }
}

bool VertexInsertion::is_positive(const ConeCharts& charts, std::uint32_t vertex) {
  domain::gather_star(charts.topology, vertex, star_);
  least_area_ = 1;
  return std::ranges::all_of(star_.corners, [&](const domain::Corner& at) {
    const LatticePoint a = charts.corner_point(at.face, 0), b = charts.corner_point(at.face, 1),
                       c = charts.corner_point(at.face, 2);
    const double longest =
        std::sqrt(std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()}));
    const double area = lattice_area(a, b, c);
    least_area_ = std::min(least_area_, area);
    return area > kLeastHeight * longest;
  });
}

}  // namespace zerotree::remesh
