#include "remesh/vertex_relaxation.h"

namespace zerotree::remesh {

void VertexRelaxation::relax(ConeCharts& charts, std::uint32_t vertex, int steps) {
  if (charts.vertices[vertex].cone != kNone) return;
  domain::gather_star(charts.topology, vertex, star_);
  ring_.closed = star_.closed;
  ring_.points.clear();
  ring_.positions.clear();
  const auto add = [&](const domain::Corner& at, int k) {
    const std::uint32_t neighbour = charts.topology.faces[at.face][k];
    const LatticePoint& point = charts.vertices[neighbour].point;
    const LatticeIsometry &theirs = charts.transitions[at.face][k],
                          &mine = charts.transitions[at.face][at.corner];
    // Most neighbours have the same chart.
    ring_.points.push_back(
        to_plane(theirs == mine ? point : apply(inverse(mine), apply(theirs, point))));
    ring_.positions.push_back(positions_[neighbour]);
  };
  for (const domain::Corner& at : star_.corners) add(at, kNext[at.corner]);
  if (!star_.closed) add(star_.corners.back(), kPrev[star_.corners.back().corner]);

  const LatticePoint point = charts.vertices[vertex].point;
  const Eigen::Vector2d start = to_plane(point);
  if (!(least_doubled_area(ring_, start) > 0)) return;
  energy_.prepare(ring_, positions_[vertex]);
  if (kinds_[vertex] == domain::VertexKind::smooth) {
    move_to(charts, vertex, to_lattice(minimise_in_plane(energy_, ring_, start, steps)));
  } else {
    const double t = minimise_on_line(energy_, ring_, {0, 0}, {1, 0}, point.x(), steps);
    if (t > 0 && t < 1) charts.vertices[vertex].point.x() = t;
  }
}

// Follows the vertex into the base triangle that it now lies in and takes on that one's chart.
void VertexRelaxation::move_to(ConeCharts& charts, std::uint32_t vertex,
                               const LatticePoint& target) {
  VertexChart& chart = charts.vertices[vertex];
  if (is_inside(target)) {
    chart.point = target;
    return;
  }
  const BasePlace place = walk(base_, chart.triangle, chart.point, target);
  chart.point = place.point;
  chart.triangle = place.triangle;
  const LatticeIsometry back = inverse(place.map);
  for (const auto& [face, corner] : star_.corners)
    charts.transitions[face][corner] = compose(charts.transitions[face][corner], back);
}

}  // namespace zerotree::remesh
