// What a collapse costs: distance from the surface, shape and valences.
#pragma once

#include <vector>

#include "domain/collapse_rules.h"
#include "domain/quadric.h"

namespace zerotree::domain {

/// Positions moved and scaled into the unit ball, so that costs do not depend on the unit.
std::vector<Eigen::Vector3f> normalised_positions(const TriangleMesh& mesh);

/// One quadric a vertex: the planes of its faces by area, and upright planes along the boundary.
/// Faces with a mark in `gone` are passed over.
std::vector<Quadric> vertex_quadrics(const TriangleTopology& topology,
                                     const std::vector<std::uint8_t>& gone,
                                     const std::vector<Eigen::Vector3f>& positions);

/// Costs of the collapses of one vertex after the other; holds scratch memory, so one per thread.
class CollapseCost {
 public:
  /// `patch_area`: of the surface, for each vertex that shall be left (normalised).
  CollapseCost(const std::vector<Eigen::Vector3f>& positions, const std::vector<Quadric>& quadrics,
               double patch_area)
      : positions_(positions), quadrics_(quadrics), patch_area_(patch_area) {}

  /// Goes to the vertex of `star`.
  void visit(const TriangleTopology& topology, const Star& star);

  /// Cost of merging the vertex as `site` says: (quadrics + area term) x aspect x exp(valence
  /// excess). Infinite if a face would flip and the caps forbid that.
  ///
  /// A quadric is squared distance times area, which would give thin limbs away for nothing: a
  /// share of it counts as if it were the area of a whole patch.
  double of(const CollapseSite& site, const CollapseCaps& caps) const;
  /// Not above the cost, from the quadrics and valences alone: much cheaper.
  double lower_bound(const CollapseSite& site) const;

 private:
  // A face of the star: the side opposite the vertex, and the face's doubled area vector.
  struct Side {
    std::uint32_t face;
    Eigen::Vector3d p, q, area;
    double size, squared_length;
  };
  double distance(const CollapseSite& site) const;

  const std::vector<Eigen::Vector3f>& positions_;
  const std::vector<Quadric>& quadrics_;
  double patch_area_;
  std::vector<Side> sides_;
};

}  // namespace zerotree::domain
