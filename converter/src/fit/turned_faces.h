// Faces of the fitted surface that look the wrong way.
#pragma once

#include <cstdint>
#include <vector>

#include "fit/input_orientation.h"
#include "fit/limit_operator.h"
#include "relax/surface_relaxation.h"

namespace zerotree::fit {

/// Finds the finest triangles that are turned (InputOrientation) and lays out the surface around
/// them anew, in ever larger patches, until none is left or nothing helps. Vertices with a mark in
/// `held` stay. `feet` are those of the limit positions and are led on. Returns how many are left.
/// The result does not depend on the number of threads. Cost: about a microsecond a face, and up to
/// 0.5 milliseconds per vertex within three rings of turned faces.
std::uint32_t turn_faces_back(const InputOrientation& orientation,
                              const relax::SubdividedLevel& finest, const LimitOperator& limit,
                              const std::vector<std::uint8_t>& held,
                              std::vector<relax::SurfacePoint>& feet, Points& points);

}  // namespace zerotree::fit
