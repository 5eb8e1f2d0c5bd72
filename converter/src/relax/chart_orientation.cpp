#include "relax/chart_orientation.h"

#include <algorithm>
#include <cmath>

namespace zerotree::relax {
namespace {

using domain::kNext;
using domain::kNone;
using domain::kPrev;
using remesh::LatticeIsometry;
using remesh::LatticePoint;

constexpr int kMostFaces = 10000;

int adjacency_towards(const remesh::BaseDomain& base, std::uint32_t from, std::uint32_t to) {
  for (int k = 0; k < 3; ++k)
    if (base.adjacent[from][static_cast<std::size_t>(k)] == to) return k;
  return -1;
}

// Turns a point about the origin by `sectors` times 60 degrees.
LatticePoint turned(const LatticePoint& point, int sectors) {
  const LatticeIsometry turn{0, 0, static_cast<std::int16_t>(((sectors % 6) + 6) % 6)};
  return remesh::apply(turn, point);
}

// The steps from one fan triangle to another, the shorter way round.
struct FanStep {
  int sectors;
  double turn;
};

}  // namespace

double ParameterChart::FanPlace::turn() const {
  const double sum = point.x() + point.y();
  return fan.index + (sum > 0 ? point.y() / sum : 0.5);
}

ParameterChart::ParameterChart(const remesh::BaseDomain& base, const remesh::ConeCharts& charts)
    : base_(base), charts_(charts), fans_(base.topology.triangles.size()) {
  // Each fan from its first triangle: at the boundary if there is one.
  for (std::uint32_t t = 0; t < fans_.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      if (fans_[t][k].size > 0) continue;
      const std::uint32_t vertex = base.topology.triangles[t][k];
      std::uint32_t first = t;
      int corner = k;
      bool closed = false;
      while (base.adjacent[first][corner] != kNone) {  // clockwise
        first = base.adjacent[first][corner];
        corner = domain::corner_of(base.topology.triangles[first], vertex);
        if ((closed = first == t)) break;
      }
      std::vector<std::array<std::uint32_t, 2>> fan;
      std::uint32_t face = first;
      do {
        corner = domain::corner_of(base.topology.triangles[face], vertex);
        fan.push_back({face, static_cast<std::uint32_t>(corner)});
        face = base.adjacent[face][kPrev[corner]];
      } while (face != kNone && face != first);
      for (std::size_t i = 0; i < fan.size(); ++i)
        fans_[fan[i][0]][fan[i][1]] = {static_cast<std::uint16_t>(i),
                                       static_cast<std::uint16_t>(fan.size()), closed};
    }
}

ChartPlace ParameterChart::place_of(const SurfacePoint& point) const {
  const remesh::FaceAnchor anchor = remesh::anchor_of(charts_, base_, point.face);
  LatticePoint in_face = LatticePoint::Zero();
  for (int k = 0; k < 3; ++k) in_face += point.weights[k] * charts_.corner_point(point.face, k);
  const remesh::BasePlace place =
      remesh::walk(base_, anchor.triangle, anchor.point, remesh::apply(anchor.map, in_face));
  return {place.triangle, place.point};
}

ParameterChart::FanPlace ParameterChart::seen_from(std::uint32_t vertex,
                                                   const ChartPlace& place) const {
  const int corner = domain::corner_of(base_.topology.triangles[place.triangle], vertex);
  return {fans_[place.triangle][corner],
          remesh::apply(remesh::inverse(remesh::corner_chart(corner)), place.point)};
}

std::optional<std::uint32_t> ParameterChart::common_vertex(std::uint32_t s, std::uint32_t t,
                                                           std::uint32_t u) const {
  const auto has = [&](std::uint32_t triangle, std::uint32_t vertex) {
    return std::ranges::count(base_.topology.triangles[triangle], vertex) > 0;
  };
  for (std::uint32_t vertex : base_.topology.triangles[s])
    if (has(t, vertex) && has(u, vertex)) return vertex;
  return std::nullopt;
}

// A base vertex of valence 3 of both triangles, the one nearer to `place`. All triangles around it
// are neighbours: which edge lies between two points then depends on the way round.
std::optional<std::uint32_t> ParameterChart::narrow_cone(const ChartPlace& place,
                                                         std::uint32_t triangle) const {
  const Triangle& corners = base_.topology.triangles[place.triangle];
  const LatticePoint& p = place.point;
  const std::array<double, 3> weights{1 - p.x() - p.y(), p.x(), p.y()};
  std::optional<std::size_t> nearest;
  for (std::size_t k = 0; k < 3; ++k) {
    const FanPosition& fan = fans_[place.triangle][k];
    if (!fan.is_closed || fan.size > 3) continue;
    if (std::ranges::count(base_.topology.triangles[triangle], corners[k]) == 0) continue;
    if (!nearest || weights[k] > weights[*nearest]) nearest = k;
  }
  return nearest ? std::optional(corners[*nearest]) : std::nullopt;
}

namespace {

FanStep step_between(double from, int from_index, double to, int to_index, int size, bool closed) {
  FanStep step{to_index - from_index, to - from};
  if (!closed) return step;
  if (step.turn > 0.5 * size) {
    step.turn -= size;
    step.sectors -= size;
  } else if (step.turn < -0.5 * size) {
    step.turn += size;
    step.sectors += size;
  }
  return step;
}

}  // namespace

bool ParameterChart::is_positive_in_fan(const FanPlace& a, const FanPlace& b,
                                        const FanPlace& c) const {
  const auto step = [](const FanPlace& from, const FanPlace& to) {
    return step_between(from.turn(), from.fan.index, to.turn(), to.fan.index, from.fan.size,
                        from.fan.is_closed);
  };
  if (a.point.isZero()) {
    return remesh::lattice_area(a.point, b.point, turned(c.point, step(b, c).sectors)) > 0;
  }
  if (b.point.isZero() || c.point.isZero()) return is_positive_in_fan(b, c, a);
  const FanStep ab = step(a, b), bc = step(b, c), ca = step(c, a);
  if (ab.sectors + bc.sectors + ca.sectors != 0)  // around the base vertex
    return ab.turn > 0 && bc.turn > 0 && ca.turn > 0;
  return remesh::lattice_area(a.point, turned(b.point, ab.sectors), turned(c.point, -ca.sectors)) >
         0;
}

bool ParameterChart::is_positive(const ChartPlace& a, const ChartPlace& b,
                                 const ChartPlace& c) const {
  if (a.triangle == b.triangle && a.triangle == c.triangle)
    return remesh::lattice_area(a.point, b.point, c.point) > 0;
  // Rotate so that a is alone if two are together.
  if (a.triangle == b.triangle) return is_positive(c, a, b);
  if (a.triangle == c.triangle) return is_positive(b, c, a);
  const auto sees = [&](std::uint32_t vertex) {
    return is_positive_in_fan(seen_from(vertex, a), seen_from(vertex, b), seen_from(vertex, c));
  };
  if (b.triangle == c.triangle) {
    if (const auto cone = narrow_cone(a, b.triangle)) return sees(*cone);
    const int k = adjacency_towards(base_, a.triangle, b.triangle);
    if (k >= 0)
      return remesh::lattice_area(remesh::apply(base_.transitions[a.triangle][k], a.point), b.point,
                                  c.point) > 0;
  }
  const auto vertex = common_vertex(a.triangle, b.triangle, c.triangle);
  return vertex.has_value() && sees(*vertex);
}

std::optional<LatticePoint> ParameterChart::unfold(const ChartPlace& place,
                                                   std::uint32_t triangle) const {
  if (place.triangle == triangle) return place.point;
  const int k = adjacency_towards(base_, place.triangle, triangle);
  if (k >= 0) return remesh::apply(base_.transitions[place.triangle][k], place.point);
  return std::nullopt;
}

std::optional<SurfacePoint> ParameterChart::midpoint(const SurfacePoint& a,
                                                     const SurfacePoint& b) const {
  const remesh::FaceAnchor anchor = remesh::anchor_of(charts_, base_, a.face);
  LatticePoint in_face = LatticePoint::Zero();
  for (int k = 0; k < 3; ++k) in_face += a.weights[k] * charts_.corner_point(a.face, k);
  const remesh::BasePlace place =
      remesh::walk(base_, anchor.triangle, anchor.point, remesh::apply(anchor.map, in_face));
  const ChartPlace end = place_of(b);
  LatticePoint target;
  const ChartPlace begin{place.triangle, place.point};
  auto vertex = begin.triangle == end.triangle ? std::nullopt : narrow_cone(begin, end.triangle);
  const auto seen = vertex ? std::nullopt : unfold(end, place.triangle);
  if (seen) {
    target = (place.point + *seen) / 2;
  } else {
    if (!vertex) vertex = common_vertex(place.triangle, end.triangle, end.triangle);
    if (!vertex) return std::nullopt;
    const FanPlace from = seen_from(*vertex, begin), to = seen_from(*vertex, end);
    const FanStep step = step_between(from.turn(), from.fan.index, to.turn(), to.fan.index,
                                      from.fan.size, from.fan.is_closed);
    const int corner = domain::corner_of(base_.topology.triangles[place.triangle], *vertex);
    target = remesh::apply(remesh::corner_chart(corner),
                           ((from.point + turned(to.point, step.sectors)) / 2).eval());
  }
  // Walk there over the faces, each in its own chart.
  LatticePoint goal =
      remesh::apply(remesh::inverse(remesh::compose(place.map, anchor.map)), target);
  SurfacePoint point = a;
  point.edge = -1;
  int entry = -1;
  for (int step = 0; step < kMostFaces; ++step) {
    const std::array<LatticePoint, 3> q{charts_.corner_point(point.face, 0),
                                        charts_.corner_point(point.face, 1),
                                        charts_.corner_point(point.face, 2)};
    const double area = remesh::lattice_area(q[0], q[1], q[2]);
    const Eigen::Vector3d wanted(remesh::lattice_area(goal, q[1], q[2]) / area,
                                 remesh::lattice_area(goal, q[2], q[0]) / area,
                                 remesh::lattice_area(goal, q[0], q[1]) / area);
    double share = 1;
    int exit = -1;
    for (int k = 0; k < 3; ++k) {
      const double from = point.weights[kPrev[k]], to = wanted[kPrev[k]];
      if (k == entry || to >= 0) continue;
      const double reach = std::max(from, 0.0) / (std::max(from, 0.0) - to);
      if (reach < share) {
        share = reach;
        exit = k;
      }
    }
    point.weights += share * (wanted - point.weights);
    point.weights = point.weights.cwiseMax(0.0);
    point.weights /= point.weights.sum();
    if (exit < 0 || charts_.topology.adjacent[point.face][exit] == kNone) return point;
    const std::uint32_t next = charts_.topology.adjacent[point.face][exit];
    const int back = domain::edge_towards(charts_.topology, next, point.face);
    goal = remesh::apply(remesh::inverse(remesh::face_transition(charts_, point.face, exit)), goal);
    Eigen::Vector3d weights = Eigen::Vector3d::Zero();
    weights[back] = point.weights[kNext[exit]];
    weights[kNext[back]] = point.weights[exit];
    weights /= weights.sum();
    point.face = next;
    point.weights = weights;
    entry = back;
  }
  return std::nullopt;
}

}  // namespace zerotree::relax
