// What the wavelet analysis hands to the encoder.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace zerotree::analysis {

/// Control points of the base and the details of every level (paper, equation 1).
struct WaveletDecomposition {
  std::vector<Eigen::Vector3d> base_control_points;
  /// details[j][e] belongs to edge e of level j (OpenSubdiv's numbering), so to vertex V_j + e of
  /// level j + 1; in the axes of the control points.
  std::vector<std::vector<Eigen::Vector3d>> details;
};

}  // namespace zerotree::analysis
