// Small parts of the fitted surface, laid out anew so that no face opposes the input.
#pragma once

#include <cstdint>
#include <vector>

#include "fit/input_orientation.h"
#include "fit/limit_operator.h"
#include "fit/untangling_patch.h"

namespace zerotree::fit {

/// Lays a patch out without folds: minimises how far its faces are from equilateral ones, which
/// grows without bound towards no area as seen along the input's normal (Garanzha et al. 2021,
/// "Foldover-free maps in 50 lines of code"), and the distance of its vertices from the input. That
/// counts `firmness` times, squared and in units of the mean area. Ends as soon as no face is
/// turned. The control points, limit positions and feet of the vertices that move are led on.
/// Returns how many of its faces stay turned; never more than there were.
/// Cost: about 20 microseconds per vertex; ten times that where nothing helps.
std::uint32_t untangle(const InputOrientation& orientation, const UntanglingPatch& patch,
                       double firmness, std::vector<relax::SurfacePoint>& feet, Points& limit,
                       Points& points);

}  // namespace zerotree::fit
