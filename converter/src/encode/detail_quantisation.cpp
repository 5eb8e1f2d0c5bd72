#include "encode/detail_quantisation.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "mesh/error.h"
#include "surface/edge_frames.h"
#include "surface/surface_synthesis.h"

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

// Fills the integers of one level, whose details are in the axes of the control points.
void quantise_level(const surface::SubdivisionLevel& from, int level,
                    const std::vector<Eigen::Vector3d>& details,
                    const surface::Dequantisation& dequantisation, double mean_area,
                    const surface::Positions& predicted, CoefficientSet& set) {
  const std::size_t begin = bitstream::level_offset(set.base_edge_count, level);
  std::array<double, bitstream::kChannelCount> units;
  for (std::size_t c = 0; c < units.size(); ++c)
    units[c] = double{surface::detail_unit(dequantisation, set.levels, level,
                                           static_cast<bitstream::Channel>(c))};
  for (std::size_t i = 0; i < from.edges.cell_to_edge.size(); ++i) {
    const std::uint32_t edge = from.edges.cell_to_edge[i];
    if (edge == bitstream::kNone) continue;
    const surface::EdgeTangents tangents = surface::edge_tangents(
        predicted.data(), from.vertex_count, from.edges.vertices[edge], from.edges.wings[edge]);
    const double weight = double{surface::area_weight(tangents.triangle_area(), mean_area)};
    const surface::Vector3 local =
        tangents.frame().components({details[edge].x(), details[edge].y(), details[edge].z()});
    for (std::size_t c = 0; c < units.size(); ++c)
      set.channels[c][begin + i] = midpoint_value(local[c] * weight, units[c], level);
  }
}

}  // namespace

CoefficientSet quantise_details(const surface::SubdivisionHierarchy& hierarchy,
                                const analysis::WaveletDecomposition& decomposition,
                                const surface::Dequantisation& dequantisation,
                                std::span<const float> base_positions) {
  const std::size_t base_edge_count = hierarchy.base_edges().size();
  CoefficientSet set{base_edge_count, hierarchy.levels(), {}};
  for (auto& channel : set.channels)
    channel.assign(bitstream::level_offset(base_edge_count, set.levels), 0);
  surface::Positions points(base_positions.begin(), base_positions.end());
  double mean_area = surface::mean_face_area(hierarchy.base(), base_positions);
  for (int level = 0; level < set.levels; ++level, mean_area /= 4) {
    const surface::SubdivisionLevel& from = hierarchy.level(level);
    surface::Positions fine = surface::subdivide(from, points);
    quantise_level(from, level, decomposition.details[static_cast<std::size_t>(level)],
                   dequantisation, mean_area, fine, set);
    if (level + 1 == set.levels) break;
    const surface::LocalDetails decoded =
        surface::dequantise(hierarchy, set, dequantisation, level);
    surface::add_details(from, surface::detail_moves(from, decoded, mean_area, fine), fine);
    points = std::move(fine);
  }
  return set;
}

}  // namespace zerotree::encode
