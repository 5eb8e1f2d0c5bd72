#include "domain/collapse_rules.h"

#include <algorithm>

namespace zerotree::domain {
namespace {

// Faces that a vertex inside a chain keeps on either side.
constexpr int kLeastSector = 2;

std::uint32_t vertex_at(const TriangleTopology& topology, const Corner& corner, int turn) {
  return topology.faces[corner.face][(corner.corner + turn) % 3];
}

// The faces that the kept vertex gets.
int count_fan(const Star& star, const CollapseSite& site) {
  const int gone = (site.left != kNone ? 1 : 0) + (site.right != kNone ? 1 : 0);
  return static_cast<int>(star.corners.size()) - gone;
}

int valence_cap(const CollapseCaps& caps) {
  return std::max(caps.valence, 3);
}

bool keeps_fan(const Star& star, const CollapseSite& site, const CollapseCaps& caps) {
  return site.kept_valence <= valence_cap(caps) &&
         count_fan(star, site) <= std::max(1.0, caps.fan_share * site.kept_valence);
}

}  // namespace

VertexFans count_fans(const TriangleTopology& topology, const std::vector<std::uint8_t>& gone) {
  VertexFans fans{std::vector<std::uint32_t>(topology.face_of_vertex.size(), 0),
                  std::vector<std::uint8_t>(topology.face_of_vertex.size(), 0)};
  for (std::uint32_t f = 0; f < topology.faces.size(); ++f) {
    if (gone[f]) continue;
    const Triangle& corners = topology.faces[f];
    for (int k = 0; k < 3; ++k) {
      ++fans.valence[corners[k]];
      if (topology.adjacent[f][k] == kNone)
        fans.is_open[corners[k]] = fans.is_open[corners[kNext[k]]] = 1;
    }
  }
  return fans;
}

void CollapseRules::visit(std::uint32_t vertex) {
  vertex_ = vertex;
  gather_star(topology_, vertex, star_);
  ring_.clear();
  for (const Corner& corner : star_.corners) ring_.push_back(vertex_at(topology_, corner, 1));
  if (!star_.closed) ring_.push_back(vertex_at(topology_, star_.corners.back(), 2));
}

bool CollapseRules::crowds(std::size_t edge, const CollapseCaps& caps) const {
  const std::uint32_t kept = ring_[edge];
  // Two faces at most go, which both vertices have.
  const std::size_t least = fans_.valence[kept] + star_.corners.size() - 4;
  return kinds_[kept] == VertexKind::smooth && static_cast<int>(least) > valence_cap(caps);
}

CollapseSite CollapseRules::site_along(std::size_t edge) const {
  const std::size_t n = star_.corners.size();
  CollapseSite site;
  site.removed = vertex_;
  site.kept = ring_[edge];
  if (edge < n) {
    site.left = star_.corners[edge].face;
    site.left_apex = ring_[edge + 1 < ring_.size() ? edge + 1 : 0];
    site.left_apex_valence = static_cast<int>(fans_.valence[site.left_apex]) - 1;
  }
  if (edge > 0 || star_.closed) {
    const std::size_t before = edge > 0 ? edge - 1 : n - 1;
    site.right = star_.corners[before].face;
    site.right_apex = ring_[before];
    site.right_apex_valence = static_cast<int>(fans_.valence[site.right_apex]) - 1;
  }
  const int gone = (site.left != kNone ? 1 : 0) + (site.right != kNone ? 1 : 0);
  site.kept_valence = static_cast<int>(fans_.valence[site.kept]) + static_cast<int>(n) - 2 * gone;
  return site;
}

int CollapseRules::added_irregularity(const CollapseSite& site) const {
  int added = 0;
  const auto change = [&](std::uint32_t vertex, int valence) {
    if (vertex == kNone || kinds_[vertex] != VertexKind::smooth) return;
    added += irregularity_of(valence) - irregularity_of(static_cast<int>(fans_.valence[vertex]));
  };
  change(site.kept, site.kept_valence);
  change(site.left_apex, site.left_apex_valence);
  change(site.right_apex, site.right_apex_valence);
  if (kinds_[site.removed] == VertexKind::smooth)
    added -= irregularity_of(static_cast<int>(fans_.valence[site.removed]));
  return added;
}

bool CollapseRules::allows(const CollapseSite& site, const CollapseCaps& caps) {
  return is_chain_step(site) && has_link_condition(site) &&
         leaves_room_at_apex(site.left, site.left_apex) &&
         leaves_room_at_apex(site.right, site.right_apex) && keeps_sectors(site, caps);
}

bool CollapseRules::keeps_valences(const CollapseSite& site, const CollapseCaps& caps) const {
  const auto enough = [&](std::uint32_t vertex, int valence) {
    return vertex == kNone || valence >= (fans_.is_open[vertex] ? 1 : 3);
  };
  if (!enough(site.kept, site.kept_valence) || !enough(site.left_apex, site.left_apex_valence) ||
      !enough(site.right_apex, site.right_apex_valence))
    return false;
  if (caps.irregularity < CollapseCaps::kAnyIrregularity &&
      added_irregularity(site) > caps.irregularity)
    return false;
  if (kinds_[site.kept] == VertexKind::smooth) return keeps_fan(star_, site, caps);
  return count_fan(star_, site) <= 2 * std::max(caps.sector, caps.valence);
}

// A chain vertex moves along its chain only, and leaves a face on each side of it: otherwise the
// undo would put all three corners of a triangle on one straight edge.
bool CollapseRules::is_chain_step(const CollapseSite& site) const {
  if (kinds_[site.removed] == VertexKind::corner) return false;
  if (kinds_[site.removed] == VertexKind::smooth) return true;
  const std::uint32_t face = site.left != kNone ? site.left : site.right;
  const int corner = corner_of(topology_.faces[face], site.removed);
  if (!is_feature(topology_, face, site.left != kNone ? corner : kPrev[corner])) return false;
  for (const auto& [f, k] : star_.corners) {
    if (f == site.left && is_feature(topology_, f, kPrev[k])) return false;
    if (f == site.right && is_feature(topology_, f, k)) return false;
  }
  return true;
}

// Dey et al. 1999: the links of both ends share nothing but the link of the edge.
bool CollapseRules::has_link_condition(const CollapseSite& site) {
  // An inner edge between two boundary vertices would pinch the surface.
  if (!star_.closed && fans_.is_open[site.kept] && site.left != kNone && site.right != kNone)
    return false;
  gather_star(topology_, site.kept, other_star_);
  const auto is_common = [&](std::uint32_t v) {
    return v != site.left_apex && v != site.right_apex &&
           std::ranges::find(ring_, v) != ring_.end();
  };
  for (const Corner& corner : other_star_.corners)
    if (is_common(vertex_at(topology_, corner, 1))) return false;
  return other_star_.closed || !is_common(vertex_at(topology_, other_star_.corners.back(), 2));
}

// Faces around `vertex` from `face` (not counted) to the next feature.
int CollapseRules::count_to_feature(std::uint32_t face, std::uint32_t vertex,
                                    bool clockwise) const {
  const std::uint32_t start = face;
  int count = 0;
  while (face != kNone) {
    const int k = corner_of(topology_.faces[face], vertex);
    const int edge = clockwise ? k : kPrev[k];
    if (is_feature(topology_, face, edge)) break;
    face = topology_.adjacent[face][edge];
    if (face == start) break;
    ++count;
  }
  return count;
}

// The apex loses the face `gone`. A vertex inside a chain needs two faces on either side: one alone
// would have all its corners on the straight edge of the domain.
bool CollapseRules::leaves_room_at_apex(std::uint32_t gone, std::uint32_t apex) const {
  if (gone == kNone || kinds_[apex] != VertexKind::chain) return true;
  return count_to_feature(gone, apex, true) + count_to_feature(gone, apex, false) >= kLeastSector;
}

// The end of a crease has no sectors to keep apart.
bool CollapseRules::is_like_smooth(std::uint32_t vertex) {
  if (kinds_[vertex] != VertexKind::corner) return false;
  gather_star(topology_, vertex, other_star_);
  int features = other_star_.closed ? 0 : 1;
  for (const auto& [face, corner] : other_star_.corners)
    features += is_feature(topology_, face, kPrev[corner]) ? 1 : 0;
  return features == 1;
}

bool CollapseRules::keeps_sectors(const CollapseSite& site, const CollapseCaps& caps) {
  if (kinds_[site.kept] == VertexKind::smooth) return true;
  if (is_like_smooth(site.kept)) return keeps_fan(star_, site, caps);
  const int fan = count_fan(star_, site);
  const int left = count_to_feature(site.left, site.kept, true);
  const int right = count_to_feature(site.right, site.kept, false);
  const bool is_corner = kinds_[site.kept] == VertexKind::corner;
  const int cap = is_corner ? caps.corner_sector : caps.sector;
  if (kinds_[site.removed] == VertexKind::smooth)
    return left + fan + right <= cap && left + fan + right >= (is_corner ? 1 : kLeastSector);

  // The chain divides the fan: count its part on the left of the chain's other edge.
  int fan_left = 0;
  std::uint32_t face = site.left;
  while (face != kNone) {
    const int k = corner_of(topology_.faces[face], site.removed);
    if (is_feature(topology_, face, kPrev[k])) break;
    face = topology_.adjacent[face][kPrev[k]];
    ++fan_left;
  }
  const int fan_right = fan - fan_left;
  // A fan that fills the whole sector leaves the removed vertex less than a straight angle only if
  // it is one face less than a straight sector.
  return (site.left == kNone || left + fan_left <= (left == 0 ? std::min(cap, 2) : cap)) &&
         (site.right == kNone || right + fan_right <= (right == 0 ? std::min(cap, 2) : cap));
}

}  // namespace zerotree::domain
