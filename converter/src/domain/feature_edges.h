// Which edges of a scan are creases.
#pragma once

#include <cstdint>

#include "domain/triangle_topology.h"
#include "mesh/triangle_mesh.h"

namespace zerotree::domain {

/// Tags the creases of `topology`, the topology of `mesh`, and returns their number.
/// `crease_angle_degrees` as in DomainOptions. O(n) but for a sort of the candidate edges.
std::uint32_t tag_crease_edges(const TriangleMesh& mesh, double crease_angle_degrees,
                               TriangleTopology& topology);

}  // namespace zerotree::domain
