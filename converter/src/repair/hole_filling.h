// Closes holes of a scan on request.
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/progress.h"
#include "mesh/triangle_mesh.h"

namespace zerotree::repair {

struct FillOptions {
  /// Boundary loops whose bounding box has a shorter diagonal than this are filled, in the mesh's
  /// own unit.
  double size = 0;
};

struct FillReport {
  /// Length of the rim of each loop that was filled, in the order of their first face.
  std::vector<double> filled_rims;
  /// ... and of each that is left.
  std::vector<double> left_rims;
  std::uint64_t added_vertices = 0;
  std::uint64_t added_faces = 0;
};

struct FilledMesh {
  /// The input's vertices and faces, then the new ones.
  TriangleMesh mesh;
  FillReport report;
};

/// Fills the small holes of the clean `mesh` (Liepa 2003): the rim is triangulated with the least
/// worst fold, refined to its density and bent to go on as the surface around it. The result is a
/// manifold; no other vertex moves. The border of a sheet is no hole: a loop stays if its filling
/// would have nine tenths of the area of its component, as it would lie on its back.
///
/// Throws Error(refused_topology) if the mesh is no manifold. Cubic in the rim up to 200 edges,
/// n log n beyond.
FilledMesh fill_holes(const TriangleMesh& mesh, const FillOptions& options,
                      const Progress& progress);

/// Closes every boundary loop that consists of `vertices` alone, flat: the two sides of a cut.
TriangleMesh close_cuts(const TriangleMesh& mesh, const std::vector<std::uint32_t>& vertices);

}  // namespace zerotree::repair
