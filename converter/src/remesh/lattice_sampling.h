// Sampling the mesh at the lattice of the base surface.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "mesh/triangle_mesh.h"
#include "remesh/cone_charts.h"
#include "remesh/lattice_numbering.h"

namespace zerotree::remesh {

struct LatticeSamples {
  /// Of each finest vertex: its point on the mesh.
  std::vector<Eigen::Vector3d> positions;
  /// Vertices that no face covers; 0 for a bijective parameterisation.
  std::uint32_t missing = 0;
};

/// Rasterises every face over the lattice. A vertex that several faces touch takes the one it lies
/// deepest in, the first of equals. `mesh` is the mesh of `charts`. O(faces + samples).
LatticeSamples sample_lattice(const TriangleMesh& mesh, const ConeCharts& charts,
                              const BaseDomain& base, const LatticeNumbering& numbering);

}  // namespace zerotree::remesh
