// Integers for the positions of the base mesh.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "bitstream/stream_header.h"

namespace zerotree::encode {

struct QuantisedBase {
  bitstream::PositionQuantisation quantisation;  ///< without initial_planes
  std::vector<std::uint32_t> integers;           ///< x, y, z per vertex
  std::vector<float> positions;                  ///< as the decoder has them in the end
};

/// Quantises in a cube over the bounding box. With `bits` 0 there are as many bits as keep the
/// length of an integer within `finest_unit`, 4 at least. The header is to hold `finest_step`, to
/// which the length of an integer is bound. Throws Error (target_not_reachable) if that takes more
/// bits than the format has and (refused_topology) if a position is not finite in single precision.
QuantisedBase quantise_base(const std::vector<Eigen::Vector3d>& positions, int bits,
                            double finest_unit, float finest_step);

}  // namespace zerotree::encode
