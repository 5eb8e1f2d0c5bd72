// Limit positions and tangents of the Loop surface at the vertices of a level.
#pragma once

#include "surface/loop_refiner.h"
#include "surface/shared_stencils.h"

namespace zerotree::surface {

/// One row per vertex of `level`: its own index and its neighbours', with three planes of weights:
/// limit position, tangent 1, tangent 2; tangent 1 x tangent 2 points outward. Weights are
/// OpenSubdiv's. Where the surface has several tangent planes the tangents span a mean of them: at
/// a crease the mean of both sides, at a corner that of the control mesh's fan. The level must have
/// its full topology.
SharedStencils limit_stencils(const RefinerLevel& level);

}  // namespace zerotree::surface
