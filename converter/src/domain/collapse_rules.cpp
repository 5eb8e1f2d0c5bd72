#include "domain/collapse_rules.h"

#include <algorithm>

namespace zerotree::domain {
namespace {

// Faces that a vertex inside a chain keeps on either side.
constexpr int kLeastSector = 2;

std::uint32_t vertex_at(const TriangleTopology& topology, const Corner& corner, int turn) {
  return topology.faces[corner.face][(corner.corner + turn) % 3];
}

}  // namespace

CollapseRules::CollapseRules(const TriangleTopology& topology, const std::vector<VertexKind>& kinds)
    : topology_(topology), kinds_(kinds), mark_(kinds.size(), 0) {}

int CollapseRules::valence(std::uint32_t vertex) {
  gather_star(topology_, vertex, other_star_);
  return static_cast<int>(other_star_.corners.size());
}

int CollapseRules::count_features(std::uint32_t vertex) {
  gather_star(topology_, vertex, other_star_);
  int count = other_star_.closed ? 0 : 1;
  for (const auto& [face, corner] : other_star_.corners)
    count += is_feature(topology_, face, kPrev[corner]) ? 1 : 0;
  return count;
}

bool CollapseRules::allows(std::uint32_t removed, const Star& star, std::size_t at, bool last,
                           const CollapseCaps& caps, CollapseSite& site) {
  const std::size_t n = star.corners.size();
  site = {};
  site.removed = removed;
  site.kept = vertex_at(topology_, star.corners[at], last ? 2 : 1);
  const bool has_left = !last, has_right = last || star.closed || at > 0;
  if (has_left) {
    site.left = star.corners[at].face;
    site.left_apex = vertex_at(topology_, star.corners[at], 2);
  }
  if (has_right) {
    const Corner& corner = star.corners[last ? at : (at + n - 1) % n];
    site.right = corner.face;
    site.right_apex = vertex_at(topology_, corner, 1);
  }
  if (!is_chain_step(star, site) || !has_link_condition(star, site)) return false;

  const int gone = (has_left ? 1 : 0) + (has_right ? 1 : 0);
  gather_star(topology_, site.kept, other_star_);
  const bool kept_closed = other_star_.closed;
  site.kept_valence =
      static_cast<int>(other_star_.corners.size()) - gone + static_cast<int>(n) - gone;
  if (site.kept_valence < (kept_closed ? 3 : 1)) return false;
  for (const auto& [apex, apex_valence] : {std::pair{site.left_apex, &site.left_apex_valence},
                                           std::pair{site.right_apex, &site.right_apex_valence}}) {
    if (apex == kNone) continue;
    *apex_valence = valence(apex) - 1;
    if (*apex_valence < (other_star_.closed ? 3 : 1)) return false;
  }
  return leaves_room_at_apex(site.left, site.left_apex) &&
         leaves_room_at_apex(site.right, site.right_apex) && keeps_caps(star, site, caps);
}

// A chain vertex moves along its chain only, and leaves a face on each side of it: otherwise the
// undo would put all three corners of a triangle on one straight edge.
bool CollapseRules::is_chain_step(const Star& star, const CollapseSite& site) const {
  if (kinds_[site.removed] == VertexKind::corner) return false;
  if (kinds_[site.removed] == VertexKind::smooth) return true;
  const std::uint32_t face = site.left != kNone ? site.left : site.right;
  const int corner = corner_of(topology_.faces[face], site.removed);
  if (!is_feature(topology_, face, site.left != kNone ? corner : kPrev[corner])) return false;
  for (const auto& [f, k] : star.corners) {
    if (f == site.left && is_feature(topology_, f, kPrev[k])) return false;
    if (f == site.right && is_feature(topology_, f, k)) return false;
  }
  return true;
}

// Dey et al. 1999: the links of both ends share nothing but the link of the edge.
bool CollapseRules::has_link_condition(const Star& star, const CollapseSite& site) {
  ++stamp_;
  const auto mark_ring = [&](const Corner& c) {
    mark_[vertex_at(topology_, c, 1)] = stamp_;
    mark_[vertex_at(topology_, c, 2)] = stamp_;
  };
  std::ranges::for_each(star.corners, mark_ring);
  gather_star(topology_, site.kept, other_star_);
  const auto is_common = [&](std::uint32_t v) {
    return mark_[v] == stamp_ && v != site.left_apex && v != site.right_apex;
  };
  for (const Corner& c : other_star_.corners) {
    if (vertex_at(topology_, c, 1) != site.removed && is_common(vertex_at(topology_, c, 1)))
      return false;
    if (vertex_at(topology_, c, 2) != site.removed && is_common(vertex_at(topology_, c, 2)))
      return false;
  }
  // An inner edge between two boundary vertices would pinch the surface.
  return star.closed || other_star_.closed || site.left == kNone || site.right == kNone;
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

bool CollapseRules::keeps_caps(const Star& star, const CollapseSite& site,
                               const CollapseCaps& caps) {
  const int gone = (site.left != kNone ? 1 : 0) + (site.right != kNone ? 1 : 0);
  const int fan = static_cast<int>(star.corners.size()) - gone;
  // The end of a crease has no sectors to keep apart.
  if (kinds_[site.kept] == VertexKind::smooth || count_features(site.kept) == 1)
    return site.kept_valence <= std::max(caps.valence, 3) &&
           fan <= std::max(1.0, caps.fan_share * site.kept_valence);

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
