// Faces of the fitted surface that look the wrong way.
#pragma once

#include <cstdint>
#include <vector>

#include "fit/limit_operator.h"
#include "relax/surface_relaxation.h"

namespace zerotree::fit {

/// The finest triangles whose normal opposes the input's normal at their point: the one a short
/// walk from a corner's foot leads to. `limit` are the limit positions. Faces whose three corners
/// lie on features are passed over: they have no side. O(triangles).
std::vector<std::uint32_t> find_turned_faces(const relax::InputSurface& input,
                                             const relax::SubdividedLevel& finest,
                                             const std::vector<relax::SurfacePoint>& foot_points,
                                             const Points& limit);

/// Smooths the control points of turned faces, a little and only there, until none is left or
/// nothing helps. Returns how many are left.
std::uint32_t turn_faces_back(const relax::InputSurface& input,
                              const relax::SubdividedLevel& finest, const LimitOperator& limit,
                              const std::vector<relax::SurfacePoint>& foot_points, Points& points);

}  // namespace zerotree::fit
