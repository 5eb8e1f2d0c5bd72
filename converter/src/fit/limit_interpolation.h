// Control points whose limit surface passes through samples of the input.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "bitstream/base_topology.h"
#include "surface/subdivision_hierarchy.h"

namespace zerotree::fit {

struct InterpolationOptions {
  /// Steps p <- p + (s - limit(p)). A limit position is a local mean (1/2 the vertex itself, the
  /// rest its neighbours in the regular case, eigenvalues 1/4 .. 1): after k steps a wave of
  /// eigenvalue l is reproduced but for (1 - l)^(k + 1), and the roughest noise in the samples
  /// is amplified by at most 4 (1 - (3/4)^(k + 1)). Few steps restore what the eye and the error
  /// see and leave alone what would only cost bits.
  int iterations = 3;
};

/// The remesher's samples lie on the input surface, but the runtime shows the limit surface of
/// control points: the samples taken as control points would shrink the surface by its curvature
/// over a few edge lengths. Returns control points of the hierarchy's finest level whose limit
/// positions are (nearly) the samples, one per vertex of that level. Boundaries, creases and
/// corners are interpolated by their own curve rules. Costs about 30 ns per vertex and iteration.
///
/// Throws Error (internal) if the number of samples is not the finest level's.
std::vector<Eigen::Vector3d> control_points_from_samples(
    const surface::SubdivisionHierarchy& hierarchy, const std::vector<Eigen::Vector3d>& samples,
    const InterpolationOptions& options);

/// The same for a mesh whose hierarchy is not at hand.
std::vector<Eigen::Vector3d> control_points_from_samples(
    const bitstream::BaseTopology& base, int levels, const std::vector<Eigen::Vector3d>& samples,
    const InterpolationOptions& options);

}  // namespace zerotree::fit
