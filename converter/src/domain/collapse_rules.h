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
};

/// A collapse of `removed` into `kept`, and what becomes of the fans around it.
struct CollapseSite {
  std::uint32_t removed = kNone, kept = kNone;
  std::uint32_t left = kNone, right = kNone;  ///< the faces of the edge, as in CollapseRecord
  std::uint32_t left_apex = kNone, right_apex = kNone;
  int kept_valence = 0;                               ///< faces around `kept` afterwards
  int left_apex_valence = 0, right_apex_valence = 0;  ///< faces around the apices afterwards
};

/// Decides on collapses; holds scratch memory, so one per thread.
class CollapseRules {
 public:
  CollapseRules(const TriangleTopology& topology, const std::vector<VertexKind>& kinds);

  /// Whether the vertex at `star` may be merged into its neighbour along the first edge of corner
  /// `at` of the star (or, with `last`, along the last edge of an open star). Fills `site`.
  bool allows(std::uint32_t removed, const Star& star, std::size_t at, bool last,
              const CollapseCaps& caps, CollapseSite& site);

 private:
  bool is_chain_step(const Star& star, const CollapseSite& site) const;
  bool has_link_condition(const Star& star, const CollapseSite& site);
  int count_to_feature(std::uint32_t face, std::uint32_t vertex, bool clockwise) const;
  bool leaves_room_at_apex(std::uint32_t gone, std::uint32_t apex) const;
  bool keeps_caps(const Star& star, const CollapseSite& site, const CollapseCaps& caps);
  int count_features(std::uint32_t vertex);
  int valence(std::uint32_t vertex);

  const TriangleTopology& topology_;
  const std::vector<VertexKind>& kinds_;
  std::vector<std::uint32_t> mark_;
  std::uint32_t stamp_ = 0;
  Star other_star_;
};

}  // namespace zerotree::domain
