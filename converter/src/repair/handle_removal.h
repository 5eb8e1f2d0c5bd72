// Cuts small handles and tunnels of a scan on request.
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/progress.h"
#include "mesh/triangle_mesh.h"

namespace zerotree::repair {

struct HandleOptions {
  /// Handles around or through which a closed path along the edges is shorter than this are
  /// removed, in the mesh's own unit.
  double size = 0;
};

struct HandleReport {
  /// Length of the loop along which each handle was cut, in the order of removal.
  std::vector<double> loops;
  std::uint64_t genus_before = 0;
  std::uint64_t genus_after = 0;
};

struct HandleFreeMesh {
  TriangleMesh mesh;
  HandleReport report;
};

/// Cuts the clean `mesh` along the shortest loop that does not part it in two and closes both
/// sides, as long as there is such a loop shorter than the size. Loops that touch the boundary are
/// passed over. Components stay in one piece; the result is a manifold.
///
/// Throws Error(refused_topology) if the mesh is no manifold. Cost: some tree searches over the
/// mesh for each round (several handles each), and for each vertex of two loops a handle a search
/// of half the size around it.
HandleFreeMesh remove_handles(const TriangleMesh& mesh, const HandleOptions& options,
                              const Progress& progress);

}  // namespace zerotree::repair
