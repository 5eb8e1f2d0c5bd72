#include "remesh/cone_charts.h"

#include <algorithm>

#include "mesh/error.h"

namespace zerotree::remesh {
namespace {

// The rotation that turns the lattice vector (ax, ay) into (bx, by), which is one of its images.
std::int16_t turns_between(int ax, int ay, int bx, int by) {
  for (std::int16_t turns = 0; turns < 6; ++turns) {
    const auto& r = kRotations[turns];
    if (r[0] * ax + r[1] * ay == bx && r[2] * ax + r[3] * ay == by) return turns;
  }
  throw Error(ExitCode::internal, "parameterisation: charts of neighbouring faces disagree");
}

}  // namespace

ConeCharts build_base_charts(const domain::Domain& domain, const BaseDomain& base) {
  ConeCharts charts;
  charts.topology = domain.topology;
  charts.transitions.resize(domain.topology.faces.size());
  charts.vertices.resize(domain.kinds.size());
  for (std::uint32_t i = 0; i < base.mesh_vertex.size(); ++i)
    charts.vertices[base.mesh_vertex[i]].cone = i;
  for (std::uint32_t b = 0; b < base.mesh_face.size(); ++b)
    for (int k = 0; k < 3; ++k) {
      const LatticeIsometry chart = corner_chart(k);
      charts.transitions[base.mesh_face[b]][(base.first_corner[b] + k) % 3] = {chart.dx, chart.dy,
                                                                               0};
    }
  return charts;
}

LatticeIsometry face_transition(const ConeCharts& charts, std::uint32_t face, int k) {
  const std::uint32_t other = charts.topology.adjacent[face][k];
  const Triangle& here = charts.topology.faces[face];
  const Triangle& there = charts.topology.faces[other];
  const int back = domain::corner_of(there, here[kNext[k]]);
  const auto& mine = charts.transitions[face];
  const auto& theirs = charts.transitions[other];
  if (charts.vertices[here[k]].cone == kNone) return compose(mine[k], inverse(theirs[kNext[back]]));
  if (charts.vertices[here[kNext[k]]].cone == kNone)
    return compose(mine[kNext[k]], inverse(theirs[back]));
  // Between two cones: the edge itself, which is integer in both charts, tells.
  const LatticeIsometry &start = theirs[kNext[back]], &end = theirs[back];
  LatticeIsometry map;
  map.turns = turns_between(end.dx - start.dx, end.dy - start.dy, mine[kNext[k]].dx - mine[k].dx,
                            mine[kNext[k]].dy - mine[k].dy);
  const LatticeIsometry moved = compose(map, start);
  map.dx = static_cast<std::int16_t>(mine[k].dx - moved.dx);
  map.dy = static_cast<std::int16_t>(mine[k].dy - moved.dy);
  return map;
}

FaceAnchor anchor_of(const ConeCharts& charts, const BaseDomain& base, std::uint32_t face) {
  for (int k = 0; k < 3; ++k) {
    const VertexChart& vertex = charts.vertices[charts.topology.faces[face][k]];
    if (vertex.cone != kNone) continue;
    const LatticeIsometry chart = corner_chart(vertex.corner);
    return {vertex.triangle, compose(chart, inverse(charts.transitions[face][k])),
            apply(chart, vertex.point)};
  }
  // A face between three cones is one of the base triangles and has kept that one's chart.
  const auto found = std::ranges::find(base.mesh_face, face);
  return {static_cast<std::uint32_t>(found - base.mesh_face.begin()), {}, {1.0 / 3, 1.0 / 3}};
}

}  // namespace zerotree::remesh
