// The best collapse of a vertex.
#pragma once

#include "domain/collapse_cost.h"
#include "domain/collapse_rules.h"

namespace zerotree::domain {

/// A mesh under decimation.
struct DecimationState {
  /// For a mesh of which `domain.collapses` are done. The vertices of `pinned` are not removed.
  /// `target` vertices shall be left.
  DecimationState(Domain& domain, const std::vector<std::uint32_t>& pinned, std::uint32_t target);

  /// Vertices that are left.
  std::size_t vertex_count() const { return positions.size() - records.size(); }
  /// Merges the vertex of `star` as `site` says, and records it.
  void apply(const Star& star, const CollapseSite& site);

  TriangleTopology& topology;
  const std::vector<VertexKind>& kinds;
  std::vector<CollapseRecord>& records;
  std::vector<CollapsePass>& passes;
  std::vector<Eigen::Vector3f> positions;
  std::vector<Quadric> quadrics;
  double patch_area = 0;  ///< of the surface for each of `target` vertices
  VertexFans fans;
  std::vector<std::uint8_t> fixed;  ///< 1 for corners, pinned and removed vertices
};

/// Chooses collapses in a mesh that does not change meanwhile; holds scratch memory, so one per
/// thread.
class CollapseChoice {
 public:
  explicit CollapseChoice(const DecimationState& state)
      : topology_(state.topology),
        rules_(state.topology, state.kinds, state.fans),
        cost_(state.positions, state.quadrics, state.patch_area) {}

  /// The cost of the cheapest collapse of `vertex` that `caps` allow, of equals that into the
  /// lowest vertex; infinite if there is none.
  double cheapest(std::uint32_t vertex, const CollapseCaps& caps, CollapseSite& best);
  /// The collapse of `vertex` into `kept`, one of its neighbours.
  CollapseSite site_into(std::uint32_t vertex, std::uint32_t kept);
  /// The faces of the vertex asked for last.
  const Star& star() const { return rules_.star(); }
  /// Its neighbours.
  const std::vector<std::uint32_t>& ring() const { return rules_.ring(); }

 private:
  // A collapse whose valences are allowed, and what it costs at least.
  struct Candidate {
    CollapseSite site;
    double least_cost;
  };

  const TriangleTopology& topology_;
  CollapseRules rules_;
  CollapseCost cost_;
  std::vector<Candidate> candidates_;
};

}  // namespace zerotree::domain
