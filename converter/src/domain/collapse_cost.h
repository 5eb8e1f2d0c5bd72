// What a collapse costs: distance from the surface, shape and valences.
#pragma once

#include <vector>

#include "domain/collapse_rules.h"
#include "domain/quadric.h"

namespace zerotree::domain {

/// Positions moved and scaled into the unit ball, so that costs do not depend on the unit.
std::vector<Eigen::Vector3d> normalised_positions(const TriangleMesh& mesh);

/// One quadric a vertex: the planes of its faces by area, and upright planes along the boundary.
/// Faces with a mark in `gone` are passed over.
std::vector<Quadric> vertex_quadrics(const TriangleTopology& topology,
                                     const std::vector<std::uint8_t>& gone,
                                     const std::vector<Eigen::Vector3d>& positions);

/// Cost of merging the vertex of `star` as `site` says: (quadric + area term) x aspect x
/// exp(valence excess). Infinite if a face would flip and `forbid_flips`.
double collapse_cost(const TriangleTopology& topology,
                     const std::vector<Eigen::Vector3d>& positions,
                     const std::vector<Quadric>& quadrics, const Star& star,
                     const CollapseSite& site, bool forbid_flips);

}  // namespace zerotree::domain
