#include "surface/surface_synthesis.h"

#include <opensubdiv/osd/bufferDescriptor.h>
#include <opensubdiv/osd/cpuEvaluator.h>

#include <algorithm>
#include <array>
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

namespace {

bool is_zero(const std::vector<float>& vectors, std::size_t edge) {
  return vectors[3 * edge] == 0.0f && vectors[3 * edge + 1] == 0.0f &&
         vectors[3 * edge + 2] == 0.0f;
}

void add(float* point, float weight, const float* move) {
  for (std::size_t axis = 0; axis < 3; ++axis) point[axis] += weight * move[axis];
}

void add_columns(const SubdivisionLevel& level, const Moves& moves, Positions& fine) {
  for (std::size_t edge = 0; edge < level.edge_count; ++edge) {
    if (is_zero(moves, edge)) continue;
    const float* weight = level.details.row_weights(edge);
    for (const std::uint32_t vertex : level.details.row_indices(edge))
      add(&fine[3 * std::size_t{vertex}], *weight++, &moves[3 * edge]);
  }
}

void add_local(const SubdivisionLevel& level, const Moves& moves, Positions& fine) {
  // Most prefixes have nothing at the finer levels.
  if (std::all_of(moves.begin(), moves.end(), [](float x) { return x == 0.0f; })) return;
  Positions lifts(3 * std::size_t{level.vertex_count}, 0.0f);
  const std::size_t first_odd = 3 * std::size_t{level.vertex_count};
  const LocalFilter& filter = level.local_details;
  for (std::size_t edge = 0; edge < level.edge_count; ++edge) {
    if (is_zero(moves, edge)) continue;
    add(&fine[first_odd + 3 * edge], 1.0f, &moves[3 * edge]);
    for (std::size_t end = 0; end < 2; ++end) {
      const std::size_t vertex = 3 * std::size_t{level.edges.vertices[edge][end]};
      add(&fine[vertex], -filter.dips[edge][end], &moves[3 * edge]);
      add(&lifts[vertex], -filter.lifts[edge][end], &moves[3 * edge]);
    }
  }
  const Positions spread = subdivide(level, lifts);
  for (std::size_t i = 0; i < fine.size(); ++i) fine[i] += spread[i];
}

}  // namespace

Moves detail_moves(const SubdivisionLevel& level, const LocalDetails& details, double mean_area,
                   const Positions& predicted) {
  Moves moves(details.size(), 0.0f);
  for (std::size_t edge = 0; edge < level.edge_count; ++edge) {
    if (is_zero(details, edge)) continue;
    const EdgeTangents tangents = edge_tangents(
        predicted.data(), level.vertex_count, level.edges.vertices[edge], level.edges.wings[edge]);
    const Vector3 local = {details[3 * edge], details[3 * edge + 1], details[3 * edge + 2]};
    const Vector3 move = detail_move(tangents, local, mean_area);
    for (std::size_t axis = 0; axis < 3; ++axis)
      moves[3 * edge + axis] = static_cast<float>(move[axis]);
  }
  return moves;
}

void add_details(const SubdivisionLevel& level, const Moves& moves, Positions& fine) {
  if (level.local_details.dips.empty())
    add_columns(level, moves, fine);
  else
    add_local(level, moves, fine);
}

LocalDetails dequantise(const SubdivisionHierarchy& hierarchy,
                        const bitstream::CoefficientSet& coefficients,
                        const Dequantisation& dequantisation, int level) {
  const std::vector<std::uint32_t>& cells = hierarchy.level(level).edges.cell_to_edge;
  const std::size_t first = bitstream::level_offset(coefficients.base_edge_count, level);
  LocalDetails details(3 * std::size_t{hierarchy.level(level).edge_count}, 0.0f);
  for (std::size_t channel = 0; channel < bitstream::kChannelCount; ++channel) {
    const std::int32_t* values = coefficients.channels[channel].data() + first;
    const float unit = detail_unit(dequantisation, coefficients.levels, level,
                                   static_cast<bitstream::Channel>(channel));
    for (std::size_t cell = 0; cell < cells.size(); ++cell)
      if (values[cell] != 0 && cells[cell] != bitstream::kNone)
        details[3 * std::size_t{cells[cell]} + channel] =
            0.5f * static_cast<float>(values[cell]) * unit;
  }
  return details;
}

Positions reconstruct(const SubdivisionHierarchy& hierarchy, const Positions& base_control_points,
                      const bitstream::CoefficientSet& coefficients,
                      const Dequantisation& dequantisation, int level) {
  double mean_area = mean_face_area(hierarchy.base(), base_control_points);
  Positions points = base_control_points;
  for (int coarse = 0; coarse < level; ++coarse, mean_area /= 4) {
    const SubdivisionLevel& from = hierarchy.level(coarse);
    Positions fine = subdivide(from, points);
    if (coarse < coefficients.levels) {
      const LocalDetails details = dequantise(hierarchy, coefficients, dequantisation, coarse);
      add_details(from, detail_moves(from, details, mean_area, fine), fine);
    }
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
      target.write(vertex, rounded.data());
    };
    if (positions.data) write(positions, sums[0]);
    if (normals.data) write(normals, frame_from_tangents(sums[1], sums[2]).normal);
  }
}

}  // namespace zerotree::surface
