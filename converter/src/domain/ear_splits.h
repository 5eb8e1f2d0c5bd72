// Splitting triangles that would be flattened by a straight feature.
#pragma once

#include <cstdint>

#include "domain/triangle_topology.h"
#include "mesh/triangle_mesh.h"

namespace zerotree::domain {

/// A triangle with two feature edges cannot lie on a straight edge of the domain with both. Splits
/// the third edge of each such triangle in the middle (or the triangle at its centroid if all
/// three are features): new vertices and faces at the end of `mesh` and `topology`, the surface
/// stays as it is. Returns how many vertices were added. A component of one triangle is left.
std::uint32_t split_ears(TriangleMesh& mesh, TriangleTopology& topology);

}  // namespace zerotree::domain
