// Q of the paper: the high pass reconstruction filter of Loop wavelets (section 3.3, figure 4).
#pragma once

#include "surface/loop_refiner.h"
#include "surface/shared_stencils.h"

namespace zerotree::surface {

/// One row per edge of `level`: what a unit detail at that edge adds to the vertices of the next
/// finer level, in OpenSubdiv's numbering.
///
/// In the regular interior that is the quadrature mirror of P's column: 10 at the odd vertex, on
/// ring 1 (edge at 0 degrees, counter-clockwise) -6 -6 +6 -6 -6 +6, on ring sqrt 3 (from 30
/// degrees) +2 -2 -2 +2 -2 -2, on ring 2 six times +1; over 16. At the edge's end points the taps
/// are numbered by edge, counted from the 10, so that they fold over at valences below 6 and leave
/// a gap above. Boundaries reflect. A crease is a boundary of both its sides, so no tap crosses it;
/// the detail of a crease or boundary edge moves the curve alone, by the quadrature mirror of the
/// cubic B-spline that the curve is: 1 -4 6 -4 1 over 8.
///
/// Every row sums to zero.
SharedStencils quadrature_mirror_stencils(const RefinerLevel& level);

}  // namespace zerotree::surface
