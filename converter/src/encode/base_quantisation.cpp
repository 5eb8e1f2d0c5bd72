#include "encode/base_quantisation.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "bitstream/position_planes.h"
#include "encode/header_writer.h"
#include "mesh/error.h"

namespace zerotree::encode {
namespace {

constexpr int kFewestBits = 4;

struct Box {
  Eigen::Vector3d low, high;
};

Box bounding_box(const std::vector<Eigen::Vector3d>& positions) {
  Box box{positions.front(), positions.front()};
  for (const Eigen::Vector3d& p : positions) {
    if (!p.cast<float>().allFinite()) {
      throw Error(ExitCode::refused_topology,
                  "a base vertex has no finite position in single precision");
    }
    box.low = box.low.cwiseMin(p);
    box.high = box.high.cwiseMax(p);
  }
  return box;
}

/// Puts the cube of integers onto the box; false if it does not cover the box.
bool place_origin(const Box& box, bitstream::PositionQuantisation& quantisation) {
  const double unit =
      std::ldexp(double{quantisation.scale}, bitstream::origin_shift(quantisation.bits));
  const double size = std::ldexp(double{quantisation.scale}, quantisation.bits);
  for (int axis = 0; axis < 3; ++axis) {
    const double units = std::floor(box.low[axis] / unit);
    if (!(std::abs(units) < 0x1p31) || !(box.high[axis] - units * unit < size)) return false;
    quantisation.origin[axis] = static_cast<std::int32_t>(units);
  }
  return true;
}

/// As many bits as the box takes in integers of length `finest_unit`.
bitstream::PositionQuantisation fitting_bits(const Box& box, double finest_unit,
                                             float finest_step) {
  // An integer need not be shorter than the spacing of the floats.
  const double largest = std::max(box.low.cwiseAbs().maxCoeff(), box.high.cwiseAbs().maxCoeff());
  bitstream::PositionQuantisation quantisation;
  quantisation.scale = storable_scale(finest_step, std::max(finest_unit, largest * 0x1p-24));
  for (int bits = kFewestBits; bits <= bitstream::kMostPositionBits; ++bits) {
    quantisation.bits = bits;
    if (place_origin(box, quantisation)) return quantisation;
  }
  throw Error(ExitCode::target_not_reachable,
              "the finest step is too small for the size of the base mesh: its positions would "
              "take more than " +
                  std::to_string(bitstream::kMostPositionBits) +
                  " bits; choose a larger step or a larger error");
}

/// The shortest integers of which 2^bits cover the box.
bitstream::PositionQuantisation fitting_scale(const Box& box, int bits, float finest_step) {
  bitstream::PositionQuantisation quantisation;
  quantisation.bits = bits;
  for (int code = 0; code < 256; ++code) {
    quantisation.scale = bitstream::scale_of(finest_step, static_cast<std::uint8_t>(code));
    if (place_origin(box, quantisation)) return quantisation;
  }
  throw Error(ExitCode::target_not_reachable,
              "the finest step is too small for so few bits of the base mesh's positions; choose a "
              "larger step or more bits");
}

}  // namespace

QuantisedBase quantise_base(const std::vector<Eigen::Vector3d>& positions, int bits,
                            double finest_unit, float finest_step) {
  const Box box = bounding_box(positions);
  QuantisedBase result;
  bitstream::PositionQuantisation& quantisation = result.quantisation;
  quantisation = bits > 0 ? fitting_scale(box, bits, finest_step)
                          : fitting_bits(box, finest_unit, finest_step);
  const double most = std::ldexp(1.0, quantisation.bits) - 1.0;
  result.integers.reserve(positions.size() * 3);
  for (const Eigen::Vector3d& p : positions) {
    for (int axis = 0; axis < 3; ++axis) {
      const double origin = std::ldexp(double{quantisation.scale} * quantisation.origin[axis],
                                       bitstream::origin_shift(quantisation.bits));
      const double cell = (p[axis] - origin) / double{quantisation.scale};
      const double q = std::clamp(std::floor(cell), 0.0, most);
      result.integers.push_back(static_cast<std::uint32_t>(q));
      result.positions.push_back(bitstream::dequantise_coordinate(
          quantisation, static_cast<std::size_t>(axis), 2 * static_cast<std::int32_t>(q) + 1));
    }
  }
  return result;
}

}  // namespace zerotree::encode
