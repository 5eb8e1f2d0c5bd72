#include "encode/detail_quantisation.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "mesh/error.h"

namespace zerotree::encode {
namespace {

using bitstream::CoefficientSet;

std::int32_t midpoint_value(double detail, double unit, int level) {
  const double magnitude = std::trunc(std::abs(detail) / unit);
  if (!(magnitude < 0x1p30)) {
    throw Error(ExitCode::target_not_reachable,
                "a detail of level " + std::to_string(level) + " (" + std::to_string(detail) +
                    ") is too large for the finest step; choose a larger step or a larger error");
  }
  const auto m = static_cast<std::int32_t>(magnitude);
  if (m == 0) return 0;
  return detail < 0 ? -(2 * m + 1) : 2 * m + 1;
}

}  // namespace

CoefficientSet quantise_details(const surface::SubdivisionHierarchy& hierarchy,
                                const analysis::WaveletDecomposition& decomposition,
                                const surface::Dequantisation& dequantisation,
                                std::span<const float> base_positions) {
  const std::size_t base_edge_count = hierarchy.base_edges().size();
  const std::vector<float> weights =
      surface::base_edge_weights(hierarchy.base(), hierarchy.base_edges(), base_positions);
  CoefficientSet set{base_edge_count, hierarchy.levels(), {}};
  for (auto& channel : set.channels) {
    channel.assign(bitstream::level_offset(base_edge_count, set.levels), 0);
  }
  for (int level = 0; level < set.levels; ++level) {
    const std::vector<std::uint32_t>& cell_to_edge = hierarchy.level(level).edges.cell_to_edge;
    const std::vector<Eigen::Vector3d>& details = decomposition.details[level];
    const std::size_t begin = bitstream::level_offset(base_edge_count, level);
    for (std::size_t i = 0; i < cell_to_edge.size(); ++i) {
      if (cell_to_edge[i] == bitstream::kNone) continue;
      const Eigen::Vector3d& detail = details[cell_to_edge[i]];
      for (int c = 0; c < bitstream::kChannelCount; ++c) {
        const float unit =
            surface::detail_unit(dequantisation, set.levels, level,
                                 static_cast<bitstream::Channel>(c), weights[i >> (2 * level)]);
        set.channels[c][begin + i] = midpoint_value(detail[c], double{unit}, level);
      }
    }
  }
  return set;
}

}  // namespace zerotree::encode
