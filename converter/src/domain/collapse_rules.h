// Which half-edge collapses keep the mesh a simplicial complex that can be undone.
#pragma once

#include <cstdint>
#include <vector>

#include "domain/domain.h"

namespace zerotree::domain {

/// Limits that keep the cone angles of the base mesh small enough for the undo to find room.
struct CollapseCaps {
  int valence = 7;           ///< around a smooth vertex
  int sector = 3;            ///< between two features at a vertex: 3 is a straight angle
  int corner_sector = 2;     ///< the same at a corner, which cannot swap: a straight one can fail
  double fan_share = 0.67;   ///< of the new valence that one collapse may bring to a smooth vertex
  bool forbid_flips = true;  ///< no face may turn by more than a right angle
  /// How much a collapse may add to the irregularity of the smooth vertices around it.
  int irregularity = kAnyIrregularity;

  static constexpr int kAnyIrregularity = 1 << 20;
};

/// How far the valence of a smooth vertex is from the range 5 to 7, on which the wavelets are well
/// conditioned.
inline int irregularity_of(int valence) {
  return valence < 5 ? 5 - valence : valence > 7 ? valence - 7 : 0;
}

/// What collapses need to know about every vertex, kept up to date by them.
struct VertexFans {
  std::vector<std::uint32_t> valence;  ///< faces around the vertex
  std::vector<std::uint8_t> is_open;   ///< 1 on the boundary, which never changes
};

/// The fans of the faces without a mark in `gone`.
VertexFans count_fans(const TriangleTopology& topology, const std::vector<std::uint8_t>& gone);

/// A collapse of `removed` into `kept`, and what becomes of the fans around it.
struct CollapseSite {
  std::uint32_t removed = kNone, kept = kNone;
  std::uint32_t left = kNone, right = kNone;  ///< the faces of the edge, as in CollapseRecord
  std::uint32_t left_apex = kNone, right_apex = kNone;
  int kept_valence = 0;                               ///< faces around `kept` afterwards
  int left_apex_valence = 0, right_apex_valence = 0;  ///< faces around the apices afterwards
};

/// Decides on the collapses of one vertex after the other; holds scratch memory, so one per thread.
class CollapseRules {
 public:
  CollapseRules(const TriangleTopology& topology, const std::vector<VertexKind>& kinds,
                const VertexFans& fans)
      : topology_(topology), kinds_(kinds), fans_(fans) {}

  /// Goes to a vertex.
  void visit(std::uint32_t vertex);
  /// Its faces.
  const Star& star() const { return star_; }
  /// Its neighbours, the i-th along its i-th edge.
  const std::vector<std::uint32_t>& ring() const { return ring_; }
  /// Its edges: the i-th is the first edge of the star's i-th corner; one more in an open star.
  std::size_t edge_count() const { return star_.corners.size() + (star_.closed ? 0 : 1); }
  /// Whether merging the vertex along its i-th edge surely gives a smooth vertex more faces than
  /// the caps allow, as it mostly does: a look before `site_along`.
  bool crowds(std::size_t edge, const CollapseCaps& caps) const;
  /// What merging the vertex along its i-th edge would do.
  CollapseSite site_along(std::size_t edge) const;
  /// Whether the valences afterwards are possible and keep the caps. O(1).
  bool keeps_valences(const CollapseSite& site, const CollapseCaps& caps) const;
  /// Whether the collapse keeps the mesh a simplicial complex that can be undone, and the caps on
  /// sectors. Only for sites that keep the valences: vertices of very many faces cost too much.
  bool allows(const CollapseSite& site, const CollapseCaps& caps);

 private:
  int added_irregularity(const CollapseSite& site) const;
  bool is_chain_step(const CollapseSite& site) const;
  bool has_link_condition(const CollapseSite& site);
  int count_to_feature(std::uint32_t face, std::uint32_t vertex, bool clockwise) const;
  bool leaves_room_at_apex(std::uint32_t gone, std::uint32_t apex) const;
  bool is_like_smooth(std::uint32_t vertex);
  bool keeps_sectors(const CollapseSite& site, const CollapseCaps& caps);

  const TriangleTopology& topology_;
  const std::vector<VertexKind>& kinds_;
  const VertexFans& fans_;
  std::uint32_t vertex_ = kNone;
  Star star_, other_star_;
  std::vector<std::uint32_t> ring_;
};

}  // namespace zerotree::domain
