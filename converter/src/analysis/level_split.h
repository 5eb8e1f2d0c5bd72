// One step of the forward transform: fine control points into coarse ones and details.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "surface/subdivision_hierarchy.h"

namespace zerotree::analysis {

using Points = std::vector<Eigen::Vector3d>;

struct SplitOptions {
  /// Residual of a solve relative to the size of the mesh.
  double tolerance = 1e-10;
  int most_iterations = 1000;
  /// At most three are used: one per coordinate.
  int threads = 1;
};

/// Details are in global axes, by edge.
struct CoarseAndDetails {
  Points coarse, details;
};

/// Solves [P Q] [coarse; details] = fine for a level whose Q is given by columns. Takes about 14
/// microseconds and 0.5 kB per fine vertex. Throws Error (internal) if the solve does not converge.
CoarseAndDetails split_by_columns(const surface::SubdivisionLevel& level, const Points& fine,
                                  const SplitOptions& options);

/// The same for a level with a local filter, whose details can be eliminated: with q = coarse -
/// lift,
///   (P_even + D P_odd) q = fine_even + D fine_odd
/// where D sums the details of the edges at a vertex with their dips; then the details are
/// fine_odd - P_odd q. A well conditioned system of one-ring rows: about 0.4 microseconds per fine
/// vertex.
CoarseAndDetails split_by_elimination(const surface::SubdivisionLevel& level, const Points& fine,
                                      const SplitOptions& options);

/// P of `level` times `coarse`.
Points subdivide(const surface::SubdivisionLevel& level, const Points& coarse);

}  // namespace zerotree::analysis
