// Long faces of the fitted surface that leave the input.
#pragma once

#include <cstdint>
#include <vector>

#include "fit/input_orientation.h"
#include "fit/limit_operator.h"
#include "relax/subdivided_levels.h"

namespace zerotree::fit {

/// Those of some faces whose longest edge is far above the mean of all edges. O(edges).
std::vector<std::uint32_t> find_long_faces(const relax::SubdividedLevel& finest,
                                           const Points& limit,
                                           const std::vector<std::uint32_t>& faces);

/// Where the base mesh has lost a limb, single vertices stay behind far from their neighbours, and
/// the fit throws them further: one such spike can outweigh the error of all the rest. Moves the
/// control points of faces that are much longer than the mean and far off the input towards their
/// neighbours until none is left, a few times at most; those on curves too, which are what is
/// thrown first. Feet off curves are led on. Returns how many faces were found at first. O(faces).
std::uint32_t draw_in_stray_faces(const InputOrientation& orientation,
                                  const relax::SubdividedLevel& finest, const LimitOperator& limit,
                                  std::vector<relax::SurfacePoint>& feet, Points& points);

}  // namespace zerotree::fit
