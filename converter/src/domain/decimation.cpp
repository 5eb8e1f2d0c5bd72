#include "domain/decimation.h"

#include <cmath>
#include <limits>

#include "domain/collapse_cost.h"
#include "domain/collapse_rules.h"
#include "domain/indexed_heap.h"

namespace zerotree::domain {
namespace {

// What is still allowed when nothing else is left to collapse above the target.
constexpr CollapseCaps kCaps[] = {
    {},
    {.valence = 8, .sector = 4, .corner_sector = 3, .fan_share = 0.75},
    {.valence = 8, .sector = 5, .corner_sector = 4, .fan_share = 0.75, .forbid_flips = false}};

// Merges `removed` into `kept`: the fan takes the place of the edge's two faces.
void collapse(TriangleTopology& topology, const Star& star, const CollapseSite& site) {
  const auto close_gap = [&](std::uint32_t gone, std::uint32_t apex) {
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
  };
  close_gap(site.left, site.left_apex);
  close_gap(site.right, site.right_apex);
  for (const auto& [face, corner] : star.corners)
    if (face != site.left && face != site.right) topology.faces[face][corner] = site.kept;
}

// From so many vertices per vertex of the base on, costs are kept exact: the base gets better by
// several percent of the rate, and the many collapses before stay quick.
constexpr std::size_t kExactPerBaseVertex = 16;

class Decimator {
 public:
  Decimator(Domain& domain, const std::vector<std::uint32_t>& pinned)
      : topology_(domain.topology),
        records_(domain.collapses),
        positions_(normalised_positions(domain.mesh)),
        quadrics_(vertex_quadrics(topology_, mark_removed_faces(domain), positions_)),
        rules_(topology_, domain.kinds),
        heap_(static_cast<std::uint32_t>(domain.kinds.size())),
        fixed_(domain.kinds.size(), 0) {
    for (std::uint32_t v = 0; v < fixed_.size(); ++v)
      fixed_[v] = domain.kinds[v] == VertexKind::corner;
    for (std::uint32_t v : pinned) fixed_[v] = 1;
    for (const CollapseRecord& record : records_) fixed_[record.removed] = 1;
  }

  void run(std::uint32_t target, const Progress& progress) {
    const std::size_t count = positions_.size();
    records_.reserve(count > target ? count - target : 0);
    exact_below_ = kExactPerBaseVertex * std::size_t{target};
    for (const CollapseCaps& caps : kCaps) {
      caps_ = caps;
      for (std::uint32_t v = 0; v < count; ++v) update(v);
      while (!heap_.empty() && count - records_.size() > target) {
        if (records_.size() % 65536 == 0)
          report_progress(progress, "decimating",
                          static_cast<double>(records_.size()) / static_cast<double>(count));
        collapse_cheapest();
      }
    }
  }

 private:
  // The cheapest allowed collapse of the vertex; infinite cost if there is none.
  double cheapest_site(std::uint32_t vertex, CollapseSite& best) {
    double best_cost = std::numeric_limits<double>::infinity();
    gather_star(topology_, vertex, star_);
    const std::size_t n = star_.corners.size();
    for (std::size_t i = 0; i < n + (star_.closed ? 0 : 1); ++i) {
      CollapseSite site;
      const bool last = i == n;
      if (!rules_.allows(vertex, star_, last ? n - 1 : i, last, caps_, site)) continue;
      const double cost =
          collapse_cost(topology_, positions_, quadrics_, star_, site, caps_.forbid_flips);
      if (cost < best_cost || (cost == best_cost && site.kept < best.kept)) {
        best_cost = cost;
        best = site;
      }
    }
    return best_cost;
  }

  void update(std::uint32_t vertex) {
    if (fixed_[vertex]) return;
    CollapseSite site;
    const double cost = cheapest_site(vertex, site);
    if (std::isfinite(cost))
      heap_.set(vertex, cost);
    else
      heap_.remove(vertex);
  }

  void collapse_cheapest() {
    const std::uint32_t vertex = heap_.top();
    CollapseSite site;
    const double cost = cheapest_site(vertex, site);
    // Costs two rings away may be out of date: look again before acting.
    if (!std::isfinite(cost)) return heap_.remove(vertex);
    if (cost > heap_.cost(vertex) * (1 + 1e-9)) return heap_.set(vertex, cost);
    heap_.remove(vertex);
    collapse(topology_, star_, site);
    quadrics_[site.kept].add(quadrics_[vertex]);
    fixed_[vertex] = 1;
    records_.push_back({vertex, site.kept, site.left, site.right});
    gather_star(topology_, site.kept, kept_star_);
    update(site.kept);
    // The others' costs have mostly risen, which is seen when their turn comes; only those that had
    // no collapse may have one now. Near the end, where each vertex counts, all are looked at.
    const bool near_end = positions_.size() - records_.size() < exact_below_;
    const auto revive = [&](std::uint32_t v) {
      if (near_end || !heap_.contains(v)) update(v);
    };
    for (const auto& [face, corner] : kept_star_.corners) {
      revive(topology_.faces[face][kNext[corner]]);
      revive(topology_.faces[face][kPrev[corner]]);
    }
  }

  TriangleTopology& topology_;
  std::vector<CollapseRecord>& records_;
  std::vector<Eigen::Vector3d> positions_;
  std::vector<Quadric> quadrics_;
  CollapseRules rules_;
  IndexedHeap heap_;
  std::vector<std::uint8_t> fixed_;  // corners, pinned and removed vertices
  CollapseCaps caps_;
  std::size_t exact_below_ = 0;
  Star star_, kept_star_;
};

}  // namespace

void decimate(Domain& domain, const std::vector<std::uint32_t>& pinned, std::uint32_t target,
              const Progress& progress) {
  Decimator(domain, pinned).run(target, progress);
}

std::vector<std::uint8_t> mark_removed_faces(const Domain& domain) {
  std::vector<std::uint8_t> removed(domain.topology.faces.size(), 0);
  for (const CollapseRecord& collapse : domain.collapses)
    for (std::uint32_t face : {collapse.left, collapse.right})
      if (face != kNone) removed[face] = 1;
  return removed;
}

void undo_collapse(TriangleTopology& topology, const CollapseRecord& collapse,
                   std::vector<std::uint32_t>& fan) {
  fan.clear();
  const auto inner_face = [&](std::uint32_t gone, bool is_left) {
    const int k = corner_of(topology.faces[gone], collapse.removed);
    return topology.adjacent[gone][is_left ? kPrev[k] : k];
  };
  const bool from_left = collapse.left != kNone;
  const std::uint32_t last = collapse.right != kNone ? inner_face(collapse.right, false) : kNone;
  std::uint32_t face = from_left ? inner_face(collapse.left, true) : last;
  // Without a left face the fan begins at the boundary: go there clockwise.
  while (!from_left) {
    const int k = corner_of(topology.faces[face], collapse.kept);
    if (topology.adjacent[face][k] == kNone) break;
    face = topology.adjacent[face][k];
  }
  while (true) {
    fan.push_back(face);
    if (face == last) break;
    face = topology.adjacent[face][kPrev[corner_of(topology.faces[face], collapse.kept)]];
    if (face == kNone) break;
  }

  const auto open_gap = [&](std::uint32_t gone, bool is_left) {
    if (gone == kNone) return;
    const std::uint32_t inner = inner_face(gone, is_left);
    const int k = corner_of(topology.faces[inner], collapse.kept);
    const int edge = is_left ? k : kPrev[k];
    const std::uint32_t outer = topology.adjacent[inner][edge];
    if (outer != kNone) topology.adjacent[outer][edge_towards(topology, outer, inner)] = gone;
    topology.adjacent[inner][edge] = gone;
    // The edge between the faces of the gap and the fan is never a feature (is_chain_step).
    topology.creases[inner] = static_cast<std::uint8_t>(topology.creases[inner] & ~(1 << edge));
    topology.face_of_vertex[collapse.kept] = gone;
  };
  open_gap(collapse.left, true);
  open_gap(collapse.right, false);
  for (std::uint32_t f : fan) {
    Triangle& corners = topology.faces[f];
    corners[corner_of(corners, collapse.kept)] = collapse.removed;
  }
  topology.face_of_vertex[collapse.removed] = fan.front();
}

}  // namespace zerotree::domain
