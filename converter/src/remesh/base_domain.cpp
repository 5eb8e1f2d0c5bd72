#include "remesh/base_domain.h"

#include <algorithm>

#include "bitstream/base_traversal.h"
#include "mesh/error.h"

namespace zerotree::remesh {
namespace {

// A walk over more base triangles than this has lost its way.
constexpr int kMaxWalk = 10000;

bitstream::BaseTopology unordered_base(const domain::Domain& domain,
                                       std::vector<std::uint32_t>& mesh_vertex) {
  bitstream::BaseTopology base;
  for (std::uint32_t f : domain.base_faces)
    for (std::uint32_t v : domain.topology.faces[f]) mesh_vertex.push_back(v);
  std::ranges::sort(mesh_vertex);
  mesh_vertex.erase(std::unique(mesh_vertex.begin(), mesh_vertex.end()), mesh_vertex.end());
  const auto index_of = [&](std::uint32_t v) {
    return static_cast<std::uint32_t>(std::ranges::lower_bound(mesh_vertex, v) -
                                      mesh_vertex.begin());
  };
  base.vertex_count = static_cast<std::uint32_t>(mesh_vertex.size());
  std::vector<std::uint32_t> features(base.vertex_count, 0);
  for (std::uint32_t f : domain.base_faces) {
    const Triangle& t = domain.topology.faces[f];
    base.triangles.push_back({index_of(t[0]), index_of(t[1]), index_of(t[2])});
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = base.triangles.back()[k], b = index_of(t[kNext[k]]);
      const std::uint32_t other = domain.topology.adjacent[f][k];
      if (!domain::is_feature(domain.topology, f, k) || (other != kNone && other < f)) continue;
      ++features[a];
      ++features[b];
      if (other != kNone) base.crease_edges.push_back({std::min(a, b), std::max(a, b)});
    }
  }
  std::ranges::sort(base.crease_edges);
  // The end of a crease (a dart) stays smooth; other corners are sharp.
  for (std::uint32_t i = 0; i < base.vertex_count; ++i)
    if (domain.kinds[mesh_vertex[i]] == domain::VertexKind::corner && features[i] != 1)
      base.corner_vertices.push_back(i);
  return base;
}

void connect(BaseDomain& base) {
  std::vector<std::uint32_t> opposites;
  const bitstream::ConnectivityStatus status = bitstream::find_opposites(base.topology, opposites);
  if (!status.ok()) throw Error(ExitCode::internal, std::string("base mesh: ") + status.problem);
  // Seen from either side, a common edge runs backwards: half a turn, then one step.
  const LatticeIsometry reverse{1, 0, 3};
  base.adjacent.resize(base.topology.triangles.size());
  base.transitions.resize(base.topology.triangles.size());
  for (std::size_t f = 0; f < base.adjacent.size(); ++f)
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t opposite = opposites[3 * f + k];
      base.adjacent[f][k] = opposite == kNone ? kNone : opposite / 3;
      if (opposite == kNone) continue;
      const LatticeIsometry there = corner_chart(static_cast<int>(opposite % 3));
      base.transitions[f][k] = compose(there, compose(reverse, inverse(corner_chart(k))));
    }
}

}  // namespace

LatticeIsometry corner_chart(int k) {
  constexpr std::array<LatticeIsometry, 3> charts{{{0, 0, 0}, {1, 0, 2}, {0, 1, 4}}};
  return charts[k];
}

BaseDomain build_base_domain(const domain::Domain& domain) {
  std::vector<std::uint32_t> mesh_vertex;
  const bitstream::BaseTopology unordered = unordered_base(domain, mesh_vertex);
  const bitstream::ConnectivityStatus status = bitstream::check_base_topology(unordered);
  if (!status.ok()) throw Error(ExitCode::internal, std::string("base mesh: ") + status.problem);
  const bitstream::BaseOrder order = bitstream::canonical_base_order(unordered);
  BaseDomain base;
  base.topology = bitstream::reorder(unordered, order);
  for (std::uint32_t old : order.vertices) base.mesh_vertex.push_back(mesh_vertex[old]);
  for (std::uint32_t old : order.triangles) base.mesh_face.push_back(domain.base_faces[old]);
  base.first_corner = order.first_corners;
  connect(base);
  return base;
}

BasePlace walk(const BaseDomain& base, std::uint32_t triangle, const LatticePoint& from,
               const LatticePoint& to) {
  BasePlace place{triangle, to, {}};
  LatticePoint start = from;
  int entry = -1;
  for (int step = 0; step < kMaxWalk && !is_inside(place.point); ++step) {
    const auto height = [](const LatticePoint& p) {
      return std::array<double, 3>{p.y(), 1 - p.x() - p.y(), p.x()};
    };
    const std::array<double, 3> at_start = height(start), at_end = height(place.point);
    int exit = -1;
    double first = 2;
    for (int k = 0; k < 3; ++k) {
      if (k == entry || at_end[k] >= 0) continue;
      const double inside = std::max(at_start[k], 0.0);
      const double share = inside / (inside - at_end[k]);
      if (share < first) {
        first = share;
        exit = k;
      }
    }
    if (exit < 0 || base.adjacent[place.triangle][exit] == kNone) return place;
    const LatticeIsometry& transition = base.transitions[place.triangle][exit];
    const std::uint32_t next = base.adjacent[place.triangle][exit];
    entry = 0;
    while (base.adjacent[next][entry] != place.triangle ||
           compose(base.transitions[next][entry], transition) != LatticeIsometry{})
      ++entry;
    start = apply(transition, start);
    place.point = apply(transition, place.point);
    place.map = compose(transition, place.map);
    place.triangle = next;
  }
  return place;
}

}  // namespace zerotree::remesh
