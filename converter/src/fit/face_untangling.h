// Small parts of the fitted surface, laid out anew so that no face opposes the input.
#pragma once

#include <cstdint>
#include <vector>

#include "fit/input_orientation.h"
#include "fit/limit_operator.h"
#include "fit/untangling_patch.h"

namespace zerotree::fit {

/// How a patch is laid out.
struct UntanglingWeights {
  /// What distances from the input count against the faces' shapes: squared, in units of the mean
  /// area.
  double firmness = 300;
  /// A face looks up along the mean of the input's normal at its centre and, with this weight each,
  /// of those at its corners: sharp bends are turned into round ones.
  double corner_share = 3;
};

/// Lays a patch out without folds: minimises how far its faces are from equilateral ones, which
/// grows without bound towards no area as seen along the input's normal (Garanzha et al. 2021,
/// "Foldover-free maps in 50 lines of code"), and the distance of its vertices from the input. Ends
/// as soon as no face is turned. The control points, limit positions and feet of the vertices that
/// move are led on. Returns how many of its faces stay turned; never more than there were.
/// Cost: about 20 microseconds per vertex; ten times that where nothing helps.
std::uint32_t untangle(const InputOrientation& orientation, const UntanglingPatch& patch,
                       const UntanglingWeights& weights, std::vector<relax::SurfacePoint>& feet,
                       Points& limit, Points& points);

}  // namespace zerotree::fit
