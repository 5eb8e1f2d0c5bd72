#include "conditioning.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "surface/surface_synthesis.h"

namespace zerotree::conformance {
namespace {

using surface::Positions;

double largest_coordinate(std::span<const float> positions) {
  double largest = 0;
  for (const float x : positions) largest = std::max(largest, std::abs(double{x}));
  return largest;
}

double diagonal(std::span<const float> positions) {
  double squares = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    float low = positions[axis], high = low;
    for (std::size_t i = axis; i < positions.size(); i += 3) {
      low = std::min(low, positions[i]);
      high = std::max(high, positions[i]);
    }
    squares += (double{high} - double{low}) * (double{high} - double{low});
  }
  return std::sqrt(squares);
}

}  // namespace

double change_by_rounding(const surface::ProgressiveSurface& surface,
                          std::span<const float> base_positions, std::span<const float> positions) {
  const bitstream::StreamHeader& header = surface.decoder().header();
  Positions moved(base_positions.begin(), base_positions.end());
  const double reach = 0x1p-24 * largest_coordinate(moved);
  std::mt19937 random(1);
  for (float& x : moved)
    x = static_cast<float>(double{x} + reach * (static_cast<double>(random()) * 0x1p-31 - 1));
  const int levels = surface.levels();
  const surface::SubdivisionHierarchy hierarchy(
      surface.base(), levels, static_cast<surface::WaveletTransform>(header.transform));
  const Positions points = surface::reconstruct(
      hierarchy, moved, surface.decoder().coefficients(),
      {header.finest_step, std::ldexp(1.0f, header.tangent_ratio_log2)}, levels);
  Positions limit(points.size());
  surface::limit_surface(hierarchy.level(levels), points, {limit.data()}, {});
  double largest = 0;
  for (std::size_t i = 0; i < limit.size(); ++i)
    largest = std::max(largest, std::abs(double{limit[i]} - double{positions[i]}));
  return largest == 0 ? 0 : largest / diagonal(positions);
}

}  // namespace zerotree::conformance
