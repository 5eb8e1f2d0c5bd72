// Numbers as colours.
#pragma once

#include <Eigen/Core>

#include "picture/image.h"

namespace zerotree::picture {

/// The colour of `share`, cut to 0..1: from cream over orange to dark violet in even steps of
/// lightness (the light part of the perceptually uniform map "magma" of Smith and van der Walt, the
/// other way round). Little is light, so that relief shows where there is little. NaN counts as 0.
Pixel ramp_colour(double share);

/// The same as the albedo of a surface: linear.
Eigen::Vector3f ramp_albedo(double share);

}  // namespace zerotree::picture
