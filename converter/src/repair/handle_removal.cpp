#include "repair/handle_removal.h"

#include <utility>

#include "domain/base_size.h"
#include "domain/triangle_topology.h"
#include "repair/hole_filling.h"
#include "repair/short_loops.h"

namespace zerotree::repair {
namespace {

using domain::kNext;
using domain::kPrev;

domain::TriangleTopology topology_of(const TriangleMesh& mesh) {
  return domain::build_topology(static_cast<std::uint32_t>(mesh.positions.size()), mesh.triangles);
}

std::uint64_t genus_of(const domain::TriangleTopology& topology) {
  std::uint64_t genus = 0;
  for (const domain::ComponentCounts& count : domain::count_components(topology, {}))
    genus += count.genus;
  return genus;
}

// Gives the faces on the left of `loop` vertices of their own. `cut_vertices` gets both.
void cut_along(const SurfaceLoop& loop, const domain::TriangleTopology& topology,
               TriangleMesh& mesh, std::vector<std::uint32_t>& cut_vertices) {
  const std::size_t n = loop.vertices.size();
  for (std::size_t i = 0; i < n; ++i) {
    const std::uint32_t v = loop.vertices[i];
    const std::uint32_t next = loop.vertices[(i + 1) % n];
    const std::uint32_t previous = loop.vertices[(i + n - 1) % n];
    const auto copy = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.push_back(Eigen::Vector3d(mesh.positions[v]));
    cut_vertices.insert(cut_vertices.end(), {v, copy});
    domain::Star star;
    domain::gather_star(topology, v, star);
    // Counter-clockwise from the edge to the next vertex to the edge to the one before.
    std::size_t at = 0;
    while (topology.faces[star.corners[at].face][kNext[star.corners[at].corner]] != next) ++at;
    for (;; at = (at + 1) % star.corners.size()) {
      const auto& [face, corner] = star.corners[at];
      mesh.triangles[face][corner] = copy;
      if (topology.faces[face][kPrev[corner]] == previous) break;
    }
  }
}

}  // namespace

HandleFreeMesh remove_handles(const TriangleMesh& mesh, const HandleOptions& options,
                              const Progress& progress) {
  HandleFreeMesh result{mesh, {}};
  domain::TriangleTopology topology = topology_of(mesh);
  result.report.genus_before = result.report.genus_after = genus_of(topology);
  while (result.report.genus_after > 0) {
    report_progress(progress, "removing handles",
                    1.0 - static_cast<double>(result.report.genus_after) /
                              static_cast<double>(result.report.genus_before));
    const std::vector<SurfaceLoop> loops = find_short_loops(result.mesh, topology, options.size);
    if (loops.empty()) break;
    std::vector<std::uint32_t> cut_vertices;
    for (const SurfaceLoop& loop : loops) {
      cut_along(loop, topology, result.mesh, cut_vertices);
      result.report.loops.push_back(loop.length);
    }
    result.mesh = close_cuts(result.mesh, cut_vertices);
    topology = topology_of(result.mesh);
    result.report.genus_after = genus_of(topology);
  }
  return result;
}

}  // namespace zerotree::repair
