// A grid of integers for the base mesh of a compressed file (KHR_mesh_quantization).
#pragma once

#include <Eigen/Core>
#include <vector>

#include "analysis/wavelet_decomposition.h"
#include "gltf/progressive_asset.h"

namespace zerotree::convert {

/// A place for a grid of 65536 points along each axis that holds `points`: its steps are about
/// 1e-5 of their size, an error far below that of any remesh. Scale and translation are numbers of
/// few digits.
gltf::Placement grid_for(const std::vector<Eigen::Vector3d>& points);

/// `wavelets` in steps of the grid, control points of the base on its points, so that accessors can
/// hold them as integers and the details refine exactly these.
analysis::WaveletDecomposition on_grid(analysis::WaveletDecomposition wavelets,
                                       const gltf::Placement& grid);

}  // namespace zerotree::convert
