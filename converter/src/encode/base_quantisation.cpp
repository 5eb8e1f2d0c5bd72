#include "encode/base_quantisation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "bitstream/position_planes.h"
#include "mesh/error.h"

namespace zerotree::encode {
namespace {

constexpr int kFewestBits = 4;

int bits_for(double extent, double finest_unit) {
  for (int bits = kFewestBits; bits <= bitstream::kMostPositionBits; ++bits) {
    if (std::ldexp(extent, -bits) <= finest_unit) return bits;
  }
  throw Error(ExitCode::target_not_reachable,
              "the finest step is too small for the size of the base mesh: its positions would "
              "take more than " +
                  std::to_string(bitstream::kMostPositionBits) +
                  " bits; choose a larger step or a larger error");
}

}  // namespace

QuantisedBase quantise_base(const std::vector<Eigen::Vector3d>& positions, int bits,
                            double finest_unit) {
  Eigen::Vector3d low = positions.front(), high = positions.front();
  for (const Eigen::Vector3d& p : positions) {
    if (!p.cast<float>().allFinite()) {
      throw Error(ExitCode::refused_topology,
                  "a base vertex has no finite position in single precision");
    }
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  QuantisedBase result;
  bitstream::PositionQuantisation& quantisation = result.quantisation;
  // A base of one point would have no scale.
  const double extent =
      std::max((high - low).maxCoeff(), double{std::numeric_limits<float>::min()});
  quantisation.bits = bits > 0 ? bits : bits_for(extent, finest_unit);
  const float scale = static_cast<float>(std::ldexp(extent, -quantisation.bits));
  quantisation.scale = std::max(scale, std::numeric_limits<float>::min());
  for (int axis = 0; axis < 3; ++axis) quantisation.origin[axis] = static_cast<float>(low[axis]);

  const double most = std::ldexp(1.0, quantisation.bits) - 1.0;
  result.integers.reserve(positions.size() * 3);
  for (const Eigen::Vector3d& p : positions) {
    for (int axis = 0; axis < 3; ++axis) {
      const double cell =
          (p[axis] - double{quantisation.origin[axis]}) / double{quantisation.scale};
      const double q = std::clamp(std::floor(cell), 0.0, most);
      result.integers.push_back(static_cast<std::uint32_t>(q));
      result.positions.push_back(bitstream::dequantise_coordinate(
          quantisation, static_cast<std::size_t>(axis), 2 * static_cast<std::int32_t>(q) + 1));
    }
  }
  return result;
}

}  // namespace zerotree::encode
