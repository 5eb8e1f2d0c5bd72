// Greedy half-edge collapses down to a base mesh.
#pragma once

#include <cstdint>
#include <vector>

#include "domain/domain.h"

namespace zerotree::domain {

/// Collapses the cheapest vertices of `topology` until `target` vertices are left or no collapse
/// is allowed. Vertices of `pinned` are not removed. `mesh` gives the positions of the vertices.
/// Returns the collapses in their order. O(n log n).
std::vector<CollapseRecord> decimate(const TriangleMesh& mesh, const std::vector<VertexKind>& kinds,
                                     const std::vector<std::uint32_t>& pinned, std::uint32_t target,
                                     TriangleTopology& topology, const Progress& progress);

}  // namespace zerotree::domain
