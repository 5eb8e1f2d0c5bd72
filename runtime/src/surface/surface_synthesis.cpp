#include "surface/surface_synthesis.h"

#include <opensubdiv/osd/bufferDescriptor.h>
#include <opensubdiv/osd/cpuEvaluator.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

#include "surface/edge_frames.h"

namespace zerotree::surface {

namespace Osd = OpenSubdiv::Osd;

Positions subdivide(const SubdivisionLevel& level, const Positions& coarse) {
  const SubdivisionStencils& stencils = level.subdivision;
  Positions fine(3 * stencils.sizes.size());
  const Osd::BufferDescriptor xyz(0, 3, 3);
  Osd::CpuEvaluator::EvalStencils(
      coarse.data(), xyz, fine.data(), xyz, stencils.sizes.data(), stencils.offsets.data(),
      stencils.indices.data(), stencils.weights.data(), 0, static_cast<int>(stencils.sizes.size()));
  return fine;
}

void add_details(const SubdivisionLevel& level, const LocalDetails& details, Positions& fine) {
  // All frames come before the first detail moves a control point.
  LocalDetails moves(details.size(), 0.0f);
  const auto is_zero = [&](std::size_t edge) {
    return details[3 * edge] == 0.0f && details[3 * edge + 1] == 0.0f &&
           details[3 * edge + 2] == 0.0f;
  };
  for (std::size_t edge = 0; edge < level.edge_count; ++edge) {
    if (is_zero(edge)) continue;
    const EdgeFrame frame = edge_frame(fine.data(), level.vertex_count, level.edges.vertices[edge],
                                       level.edges.wings[edge]);
    for (std::size_t axis = 0; axis < 3; ++axis)
      moves[3 * edge + axis] = static_cast<float>(frame.normal[axis] * details[3 * edge] +
                                                  frame.tangent1[axis] * details[3 * edge + 1] +
                                                  frame.tangent2[axis] * details[3 * edge + 2]);
  }
  for (std::size_t edge = 0; edge < level.edge_count; ++edge) {
    if (is_zero(edge)) continue;
    const float* move = &moves[3 * edge];
    const float* weight = level.details.row_weights(edge);
    for (const std::uint32_t vertex : level.details.row_indices(edge)) {
      float* point = &fine[3 * std::size_t{vertex}];
      for (std::size_t axis = 0; axis < 3; ++axis) point[axis] += *weight * move[axis];
      ++weight;
    }
  }
}

LocalDetails dequantise(const SubdivisionHierarchy& hierarchy,
                        const bitstream::CoefficientSet& coefficients,
                        const Dequantisation& dequantisation,
                        const std::vector<float>& edge_weights, int level) {
  const std::vector<std::uint32_t>& cells = hierarchy.level(level).edges.cell_to_edge;
  const std::size_t first = bitstream::level_offset(coefficients.base_edge_count, level);
  LocalDetails details(3 * std::size_t{hierarchy.level(level).edge_count}, 0.0f);
  for (int channel = 0; channel < bitstream::kChannelCount; ++channel) {
    const auto kind = static_cast<bitstream::Channel>(channel);
    const std::int32_t* values =
        coefficients.channels[static_cast<std::size_t>(channel)].data() + first;
    const std::size_t cells_per_base_edge = std::size_t{1} << (2 * level);
    for (std::size_t base_edge = 0; base_edge < edge_weights.size(); ++base_edge) {
      const float unit =
          detail_unit(dequantisation, coefficients.levels, level, kind, edge_weights[base_edge]);
      const std::size_t begin = base_edge * cells_per_base_edge;
      for (std::size_t cell = begin; cell < begin + cells_per_base_edge; ++cell)
        if (values[cell] != 0 && cells[cell] != bitstream::kNone)
          details[3 * std::size_t{cells[cell]} + static_cast<std::size_t>(channel)] =
              0.5f * static_cast<float>(values[cell]) * unit;
    }
  }
  return details;
}

Positions reconstruct(const SubdivisionHierarchy& hierarchy, const Positions& base_control_points,
                      const bitstream::CoefficientSet& coefficients,
                      const Dequantisation& dequantisation, int level) {
  const std::vector<float> weights =
      base_edge_weights(hierarchy.base(), hierarchy.base_edges(), base_control_points);
  Positions points = base_control_points;
  for (int coarse = 0; coarse < level; ++coarse) {
    Positions fine = subdivide(hierarchy.level(coarse), points);
    if (coarse < coefficients.levels)
      add_details(hierarchy.level(coarse),
                  dequantise(hierarchy, coefficients, dequantisation, weights, coarse), fine);
    points = std::move(fine);
  }
  return points;
}

void limit_surface(const SubdivisionLevel& level, const Positions& control_points,
                   StridedVectors positions, StridedVectors normals) {
  for (std::size_t vertex = 0; vertex < level.vertex_count; ++vertex) {
    const auto ring = level.limit.row_indices(vertex);
    const float* weights = level.limit.row_weights(vertex);
    std::array<Vector3, 3> sums{};
    for (std::size_t plane = 0; plane < 3; ++plane)
      for (std::size_t k = 0; k < ring.size(); ++k)
        for (std::size_t axis = 0; axis < 3; ++axis)
          sums[plane][axis] += static_cast<double>(weights[plane * ring.size() + k]) *
                               control_points[3 * std::size_t{ring[k]} + axis];
    const auto write = [&](const StridedVectors& target, const Vector3& value) {
      const std::array<float, 3> rounded = {
          static_cast<float>(value[0]), static_cast<float>(value[1]), static_cast<float>(value[2])};
      std::memcpy(static_cast<char*>(target.data) + vertex * target.stride, rounded.data(),
                  sizeof rounded);
    };
    if (positions.data) write(positions, sums[0]);
    if (normals.data) write(normals, frame_from_tangents(sums[1], sums[2]).normal);
  }
}

}  // namespace zerotree::surface
