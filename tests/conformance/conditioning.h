// Whether rounding decides what a prefix looks like.
#pragma once

#include <span>

#include "progressive/progressive_surface.h"

namespace zerotree::conformance {

/// How much limit positions at the finest level change when every base coordinate is moved by
/// about what rounding to f32 moves it, over the diagonal of their box. A detail's frame is that of
/// a surface; where this has no extent yet, as with few planes of positions, rounding turns it, and
/// no two decoders agree. `positions` are those of the surface. Costs a synthesis with stencils.
double change_by_rounding(const surface::ProgressiveSurface& surface,
                          std::span<const float> base_positions, std::span<const float> positions);

}  // namespace zerotree::conformance
