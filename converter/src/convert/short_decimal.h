// Numbers rounded to few decimal digits, to one side.
#pragma once

namespace zerotree::convert {

/// The smallest number of `digits` significant decimal digits that is not below `value`, which must
/// be positive; the double nearest to it.
double rounded_up(double value, int digits);

/// A number of few decimal places, at most `value` and above `value - step`. `step` is positive.
double rounded_down(double value, double step);

/// At least `value` and below `value + step`.
double rounded_up_by_step(double value, double step);

}  // namespace zerotree::convert
