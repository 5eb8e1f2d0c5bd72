// Says whether a mesh is an oriented 2-manifold with boundary, and counts what makes its topology.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mesh/triangle_mesh.h"

namespace zerotree::clean {

/// Empty if `mesh` is an oriented 2-manifold with boundary: indices in range and distinct, no two
/// faces alike, every edge in one face or in two of opposite direction, every vertex with exactly
/// one fan of faces. Else a sentence that names the first place where it is not. O(n log n).
std::string check_manifold(const TriangleMesh& mesh);

struct SurfaceTopology {
  /// Component of each face, numbered by first face.
  std::vector<std::uint32_t> face_component;
  std::uint32_t component_count = 0;
  std::uint64_t boundary_edges = 0;
  std::uint64_t boundary_loops = 0;
  std::int64_t euler_characteristic = 0;
  /// (2 components - loops - characteristic) / 2.
  std::int64_t genus = 0;
};

/// Counts for a mesh that passes check_manifold. Linear.
SurfaceTopology measure_topology(const TriangleMesh& mesh);

/// Both at once, which costs little more than either.
struct SurfaceInspection {
  std::string problem;
  SurfaceTopology topology;  ///< if there is no problem
};
SurfaceInspection inspect_surface(const TriangleMesh& mesh);

}  // namespace zerotree::clean
