#include "domain/base_size.h"

#include <algorithm>

namespace zerotree::domain {
namespace {

// Limbs and ears need base vertices of their own: one in 200 keeps them on scans of some 10,000
// vertices. Denser scans show the same shape with more samples, and do with one in 400.
constexpr std::uint32_t kInputPerBaseVertex = 200;
constexpr std::uint32_t kInputPerBaseVertexDense = 400;
constexpr std::uint32_t kEnoughForLimbs = 250;
// Small meshes need more than their share: this many vertices, but no more than one in 16.
constexpr std::uint32_t kSmallBase = 90;
constexpr std::uint32_t kInputPerSmallBaseVertex = 16;

std::uint32_t count_components(const TriangleTopology& topology) {
  std::vector<std::uint8_t> seen(topology.faces.size(), 0);
  std::vector<std::uint32_t> stack;
  std::uint32_t count = 0;
  for (std::uint32_t first = 0; first < topology.faces.size(); ++first) {
    if (seen[first]) continue;
    ++count;
    seen[first] = 1;
    stack.push_back(first);
    while (!stack.empty()) {
      const std::uint32_t face = stack.back();
      stack.pop_back();
      for (std::uint32_t next : topology.adjacent[face]) {
        if (next == kNone || seen[next]) continue;
        seen[next] = 1;
        stack.push_back(next);
      }
    }
  }
  return count;
}

// The boundary edge after edge `k` of `face`, around the same loop.
Corner next_boundary_edge(const TriangleTopology& topology, Corner edge) {
  const std::uint32_t end = topology.faces[edge.face][kNext[edge.corner]];
  Corner next{edge.face, kNext[edge.corner]};
  while (topology.adjacent[next.face][next.corner] != kNone) {
    const std::uint32_t face = topology.adjacent[next.face][next.corner];
    next = {face, corner_of(topology.faces[face], end)};
  }
  return next;
}

}  // namespace

void count_topology(const TriangleTopology& topology, DomainReport& report) {
  report.components = count_components(topology);
  std::vector<std::uint8_t> seen(topology.faces.size(), 0);
  std::size_t boundary_edges = 0;
  report.boundary_loops = 0;
  for (std::uint32_t f = 0; f < topology.faces.size(); ++f)
    for (int k = 0; k < 3; ++k) {
      if (topology.adjacent[f][k] != kNone || ((seen[f] >> k) & 1) != 0) continue;
      ++report.boundary_loops;
      for (Corner e{f, k}; ((seen[e.face] >> e.corner) & 1) == 0;
           e = next_boundary_edge(topology, e)) {
        seen[e.face] = static_cast<std::uint8_t>(seen[e.face] | (1 << e.corner));
        ++boundary_edges;
      }
    }
  const auto faces = static_cast<std::int64_t>(topology.faces.size());
  const std::int64_t edges = (3 * faces + static_cast<std::int64_t>(boundary_edges)) / 2;
  const std::int64_t euler =
      static_cast<std::int64_t>(topology.face_of_vertex.size()) - edges + faces;
  report.genus = static_cast<std::uint32_t>(
      (2 * std::int64_t{report.components} - report.boundary_loops - euler) / 2);
}

std::uint32_t automatic_base_size(std::uint32_t vertices, const DomainReport& report) {
  const std::uint32_t needed =
      4 * report.components + 4 * report.boundary_loops + 6 * report.genus + 2 * report.corners;
  const std::uint32_t small = std::min(kSmallBase, vertices / kInputPerSmallBaseVertex);
  const std::uint32_t by_density =
      std::min(vertices / kInputPerBaseVertex,
               std::max(kEnoughForLimbs, vertices / kInputPerBaseVertexDense));
  // Features take their base vertices away from the surface between them.
  return std::min(vertices, std::max({by_density + std::min(by_density, needed), needed, small}));
}

}  // namespace zerotree::domain
