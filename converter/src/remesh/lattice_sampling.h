// Sampling the mesh at the lattice of the base surface.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "remesh/cone_charts.h"
#include "remesh/lattice_numbering.h"

namespace zerotree::remesh {

struct LatticeSamples {
  /// Of each finest vertex: the face of the mesh that it lies on and the weights of its corners.
  std::vector<std::uint32_t> faces;
  std::vector<Eigen::Vector3d> weights;
  /// Vertices that no face covers; 0 for a bijective parameterisation.
  std::uint32_t missing = 0;
};

/// Rasterises every face over the lattice. A vertex that several faces touch takes the one it lies
/// deepest in, the first of equals. O(faces + samples).
LatticeSamples sample_lattice(const ConeCharts& charts, const BaseDomain& base,
                              const LatticeNumbering& numbering);

}  // namespace zerotree::remesh
