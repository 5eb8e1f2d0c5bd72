#include "domain/collapse_choice.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "domain/decimation.h"

namespace zerotree::domain {
namespace {

// The edge of `gone` at the removed vertex vanishes: the faces on both sides become neighbours.
void close_gap(TriangleTopology& topology, const CollapseSite& site, std::uint32_t gone,
               std::uint32_t apex) {
  if (gone == kNone) return;
  const int k = corner_of(topology.faces[gone], apex);
  const int to_removed = topology.faces[gone][kNext[k]] == site.removed ? k : kPrev[k];
  const int to_kept = to_removed == k ? kPrev[k] : k;
  const std::uint32_t inner = topology.adjacent[gone][to_removed];
  const std::uint32_t outer = topology.adjacent[gone][to_kept];
  const int inner_edge = edge_towards(topology, inner, gone);
  const int bit = (topology.creases[gone] >> to_kept) & 1;
  topology.adjacent[inner][inner_edge] = outer;
  topology.creases[inner] = static_cast<std::uint8_t>(
      (topology.creases[inner] & ~(1 << inner_edge)) | (bit << inner_edge));
  if (outer != kNone) topology.adjacent[outer][edge_towards(topology, outer, gone)] = inner;
  topology.face_of_vertex[apex] = inner;
  topology.face_of_vertex[site.kept] = inner;
}

}  // namespace

DecimationState::DecimationState(Domain& domain, const std::vector<std::uint32_t>& pinned,
                                 std::uint32_t target)
    : topology(domain.topology),
      kinds(domain.kinds),
      records(domain.collapses),
      passes(domain.passes),
      positions(normalised_positions(domain.mesh)),
      fixed(domain.kinds.size(), 0) {
  const std::vector<std::uint8_t> gone = mark_removed_faces(domain);
  quadrics = vertex_quadrics(topology, gone, positions);
  for (const Quadric& quadric : quadrics) patch_area += quadric.weight();
  patch_area /= std::max(target, 1u);
  fans = count_fans(topology, gone);
  for (std::uint32_t v = 0; v < fixed.size(); ++v) fixed[v] = kinds[v] == VertexKind::corner;
  for (std::uint32_t v : pinned) fixed[v] = 1;
  for (const CollapseRecord& record : records) fixed[record.removed] = 1;
}

void DecimationState::apply(const Star& star, const CollapseSite& site) {
  close_gap(topology, site, site.left, site.left_apex);
  close_gap(topology, site, site.right, site.right_apex);
  for (const auto& [face, corner] : star.corners)
    if (face != site.left && face != site.right) topology.faces[face][corner] = site.kept;
  fans.valence[site.kept] = static_cast<std::uint32_t>(site.kept_valence);
  if (site.left_apex != kNone) --fans.valence[site.left_apex];
  if (site.right_apex != kNone) --fans.valence[site.right_apex];
  fans.valence[site.removed] = 0;
  quadrics[site.kept].add(quadrics[site.removed],
                          (positions[site.kept] - positions[site.removed]).cast<double>());
  fixed[site.removed] = 1;
  records.push_back({site.removed, site.kept, site.left, site.right});
}

double CollapseChoice::cheapest(std::uint32_t vertex, const CollapseCaps& caps,
                                CollapseSite& best) {
  double best_cost = std::numeric_limits<double>::infinity();
  rules_.visit(vertex);
  candidates_.clear();
  for (std::size_t i = 0; i < rules_.edge_count(); ++i) {
    if (rules_.crowds(i, caps)) continue;
    const CollapseSite site = rules_.site_along(i);
    if (rules_.keeps_valences(site, caps)) candidates_.push_back({site, cost_.lower_bound(site)});
  }
  if (candidates_.empty()) return best_cost;
  // The most promising comes first: most of the others then cost too much at least.
  std::iter_swap(candidates_.begin(),
                 std::ranges::min_element(candidates_, {}, &Candidate::least_cost));
  cost_.visit(topology_, rules_.star());
  for (const auto& [site, least_cost] : candidates_) {
    if (least_cost > best_cost) continue;
    const double cost = cost_.of(site, caps);
    if (!std::isfinite(cost) || cost > best_cost || (cost == best_cost && site.kept >= best.kept))
      continue;
    if (!rules_.allows(site, caps)) continue;
    best_cost = cost;
    best = site;
  }
  return best_cost;
}

CollapseSite CollapseChoice::site_into(std::uint32_t vertex, std::uint32_t kept) {
  rules_.visit(vertex);
  std::size_t edge = 0;
  while (rules_.site_along(edge).kept != kept) ++edge;
  return rules_.site_along(edge);
}

}  // namespace zerotree::domain
