// Short closed paths that do not part a surface in two.
#pragma once

#include <cstdint>
#include <vector>

#include "domain/triangle_topology.h"
#include "mesh/triangle_mesh.h"

namespace zerotree::repair {

/// A closed path along edges, without a vertex twice.
struct SurfaceLoop {
  std::vector<std::uint32_t> vertices;
  double length = 0;
};

/// Loops shorter than `max_length` that part no component in two, not even all together, and have
/// no common vertices or neighbours: as many as are found, the shortest first. While there is any
/// such loop in the mesh that avoids its boundary, at least one is found, and that is the shortest.
///
/// A tree of edges and a tree of faces that does not cross it leave two loops for each handle
/// (Eppstein 2003). A loop that does not part the surface meets one of them, so the search for
/// short ones (Dijkstra, as far as half of `max_length`) begins at their vertices.
std::vector<SurfaceLoop> find_short_loops(const TriangleMesh& mesh,
                                          const domain::TriangleTopology& topology,
                                          double max_length);

}  // namespace zerotree::repair
