// Faces of the fitted surface that look the wrong way.
#pragma once

#include <cstdint>
#include <vector>

#include "fit/limit_operator.h"
#include "relax/surface_relaxation.h"

namespace zerotree::fit {

/// Finds the finest triangles whose normal opposes the input's at their point (the nearest one that
/// short walks from their corners' feet lead to) and smooths their control points, a little and
/// only there, until none is left or nothing helps. Vertices with a mark in `held` stay. Faces
/// whose three corners lie on features are passed over: they have no side. Returns how many are
/// left.
std::uint32_t turn_faces_back(const relax::InputSurface& input,
                              const relax::SubdividedLevel& finest, const LimitOperator& limit,
                              const std::vector<relax::SurfacePoint>& foot_points,
                              const std::vector<std::uint8_t>& held, Points& points);

}  // namespace zerotree::fit
