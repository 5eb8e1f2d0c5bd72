// The forward wavelet transform (paper, section 3.3).
#pragma once

#include <Eigen/Core>
#include <vector>

#include "analysis/wavelet_decomposition.h"
#include "bitstream/base_topology.h"
#include "mesh/progress.h"
#include "surface/subdivision_hierarchy.h"

namespace zerotree::analysis {

struct AnalysisOptions {
  /// What the details are for: the transform that the stream names.
  surface::WaveletTransform transform = surface::WaveletTransform::loop_local;
  /// Residual of each level's solve relative to the size of the mesh (root mean square of the
  /// centred control points): far below a finest quantisation step.
  double tolerance = 1e-10;
  /// Iterations after which a level counts as not solvable; 40 to 60 are usual.
  int most_iterations = 1000;
  /// Threads to use, at most three: one per coordinate. The result does not depend on it.
  int threads = 1;
};

/// Splits the control points of the hierarchy's finest level into those of the base and the
/// details of each level, finest first, by solving [P Q] [p; d] = fine (see level_split.h for the
/// costs).
///
/// Throws Error (internal) if the number of points is not the finest level's, a point is not
/// finite, or a solve does not converge.
WaveletDecomposition analyse(const surface::SubdivisionHierarchy& hierarchy,
                             const std::vector<Eigen::Vector3d>& finest_control_points,
                             const AnalysisOptions& options, const Progress& progress);

/// The same for a mesh whose hierarchy is not at hand.
WaveletDecomposition analyse(const bitstream::BaseTopology& base, int levels,
                             const std::vector<Eigen::Vector3d>& finest_control_points,
                             const AnalysisOptions& options, const Progress& progress);

}  // namespace zerotree::analysis
