#include <algorithm>
#include <limits>
#include <vector>

#include "domain/base_size.h"
#include "domain/decimation.h"
#include "domain/domain.h"
#include "domain/ear_splits.h"
#include "domain/feature_edges.h"
#include "domain/feature_vertices.h"
#include "domain/shape_complexity.h"

namespace zerotree::domain {
namespace {

// The faces that no collapse removed.
std::vector<std::uint32_t> remaining_faces(const Domain& domain) {
  const std::vector<std::uint8_t> removed = mark_removed_faces(domain);
  std::vector<std::uint32_t> faces;
  for (std::uint32_t f = 0; f < removed.size(); ++f)
    if (!removed[f]) faces.push_back(f);
  return faces;
}

void count_base(Domain& domain) {
  std::vector<std::uint32_t> valences(domain.kinds.size(), 0);
  for (std::uint32_t f : domain.base_faces)
    for (std::uint32_t v : domain.topology.faces[f]) ++valences[v];
  DomainReport& report = domain.report;
  report.base_vertices = 0;
  report.max_valence = 0;
  report.min_valence = std::numeric_limits<std::uint32_t>::max();
  report.low_valences = report.high_valences = 0;
  for (std::size_t v = 0; v < valences.size(); ++v) {
    const std::uint32_t valence = valences[v];
    if (valence == 0) continue;
    ++report.base_vertices;
    report.min_valence = std::min(report.min_valence, valence);
    report.max_valence = std::max(report.max_valence, valence);
    if (domain.kinds[v] != VertexKind::smooth) continue;
    report.low_valences += valence < 5 ? 1 : 0;
    report.high_valences += valence > 7 ? 1 : 0;
  }
  report.base_faces = static_cast<std::uint32_t>(domain.base_faces.size());
  report.collapses = static_cast<std::uint32_t>(domain.collapses.size());
}

void decimate_to_base(const DomainOptions& options, const Progress& progress, Domain& domain) {
  decimate(domain, options.pinned_vertices, domain.report.target_base_vertices, progress);
  domain.base_faces = remaining_faces(domain);
  count_base(domain);
}

}  // namespace

Domain build_domain(const TriangleMesh& mesh, const DomainOptions& options,
                    const Progress& progress) {
  report_progress(progress, "finding features", 0.0);
  Domain domain;
  domain.mesh = mesh;
  const auto vertex_count = static_cast<std::uint32_t>(mesh.positions.size());
  domain.topology = build_topology(vertex_count, mesh.triangles);
  domain.report.crease_edges =
      tag_crease_edges(mesh, options.crease_angle_degrees, domain.topology);
  domain.report.ear_splits = split_ears(domain.mesh, domain.topology);
  domain.kinds = classify_vertices(domain.mesh, domain.topology);
  const std::vector<ComponentCounts> components = count_components(domain.topology, domain.kinds);
  sum_topology(components, domain.report);
  domain.report.target_base_vertices =
      options.base_vertices > 0
          ? options.base_vertices
          : automatic_base_size(components, shape_complexity(domain.mesh, domain.topology),
                                options.goal);
  decimate_to_base(options, progress, domain);
  return domain;
}

void rebuild_base(Domain& domain, const DomainOptions& options, std::size_t keep,
                  const Progress& progress) {
  std::vector<std::uint32_t> fan;
  while (domain.collapses.size() > keep) {
    undo_collapse(domain.topology, domain.collapses.back(), fan);
    domain.collapses.pop_back();
  }
  std::erase_if(domain.passes, [&](const CollapsePass& pass) { return pass.begin >= keep; });
  if (!domain.passes.empty()) domain.passes.back().end = std::min(domain.passes.back().end, keep);
  if (options.base_vertices > 0) domain.report.target_base_vertices = options.base_vertices;
  decimate_to_base(options, progress, domain);
}

}  // namespace zerotree::domain
