// Minimising a smooth function of many points.
#pragma once

#include <functional>

#include "fit/limit_operator.h"

namespace zerotree::fit {

/// A smooth function of points that also writes its gradient, which has the points' size.
using Energy = std::function<double(const Points& points, Points& gradient)>;

/// Goes downhill from `points` by the limited-memory BFGS method (Nocedal 1980) with steps halved
/// until they pay (Armijo): at most `iterations` of them, each about one evaluation. No point moves
/// by more than `longest_step` in one of them. Returns the energy reached, which is never more than
/// that of the start.
double minimise(const Energy& energy, int iterations, double longest_step, Points& points);

}  // namespace zerotree::fit
