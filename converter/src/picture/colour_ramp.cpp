#include "picture/colour_ramp.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace zerotree::picture {
namespace {

constexpr std::array<Pixel, 8> kStops{{{252, 253, 191, 255},
                                       {254, 202, 141, 255},
                                       {253, 150, 104, 255},
                                       {241, 96, 93, 255},
                                       {205, 64, 113, 255},
                                       {158, 47, 127, 255},
                                       {114, 31, 129, 255},
                                       {68, 15, 118, 255}}};

float linear(std::uint8_t encoded) {  // inverse of sRGB's transfer function
  const float v = static_cast<float>(encoded) / 255.0F;
  return v <= 0.04045F ? v / 12.92F : std::pow((v + 0.055F) / 1.055F, 2.4F);
}

}  // namespace

Pixel ramp_colour(double share) {
  const double place = (share > 0 ? std::min(share, 1.0) : 0.0) * (kStops.size() - 1);
  const std::size_t stop = std::min(static_cast<std::size_t>(place), kStops.size() - 2);
  return blend(kStops[stop], kStops[stop + 1],
               static_cast<float>(place - static_cast<double>(stop)));
}

Eigen::Vector3f ramp_albedo(double share) {
  const Pixel colour = ramp_colour(share);
  return {linear(colour[0]), linear(colour[1]), linear(colour[2])};
}

}  // namespace zerotree::picture
