#include "lattice/surface_measures.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "surface/detail_weights.h"

namespace zerotree::surface {

namespace {

template <class Value>
std::int32_t largest(const Value* values, std::size_t count) {
  std::int32_t most = 0;
  for (std::size_t i = 0; i < count; ++i)
    most = std::max(most, std::abs(static_cast<std::int32_t>(values[i])));
  return most;
}

float distance_to_middle(const PointF& odd, const PointF& tail, const PointF& head) {
  const PointF offset = odd - 0.5f * (tail + head);
  return std::sqrt(offset.x * offset.x + offset.y * offset.y + offset.z * offset.z);
}

/// Raises the heights of all levels by the edges of one base triangle, whose points these are.
void raise_heights(const LatticeMesh& mesh, std::span<const PointF> points,
                   std::vector<float>& heights) {
  for (std::size_t level = 0; level < heights.size(); ++level) {
    const LatticeLevel& lattice = mesh.lattice(static_cast<int>(level));
    const LatticeLevel& finer = mesh.lattice(static_cast<int>(level) + 1);
    float& height = heights[level];
    const auto raise = [&](std::uint32_t odd, std::uint32_t tail, std::uint32_t head) {
      height = std::max(height, distance_to_middle(points[odd], points[tail], points[head]));
    };
    for (const auto& edges : lattice.edges)
      for (const LatticeEdge& edge : edges) raise(edge.odd, edge.tail, edge.head);
    for (const auto& side : finer.side_points)
      for (std::size_t i = 1; i < side.size(); i += 2) raise(side[i], side[i - 1], side[i + 1]);
  }
}

}  // namespace

float longest_move(const LevelDetails& details, std::size_t cells) {
  double squared = 0.0;
  for (std::size_t c = 0; c < details.channels.size(); ++c) {
    const ChannelValues& values = details.channels[c];
    const std::int32_t most = values.narrow ? largest(values.narrow, cells)
                              : values.wide ? largest(values.wide, cells)
                                            : 0;
    const double length = 0.5 * most * static_cast<double>(details.units[c]);
    squared += length * length;
  }
  // No area weight is less than the root of the mean's share.
  return static_cast<float>(std::sqrt(squared / kMeanAreaShare));
}

std::vector<float> chord_heights(const LatticeMesh& mesh, int level,
                                 std::span<const float> positions) {
  std::vector<float> heights(static_cast<std::size_t>(level), 0.0f);
  std::vector<PointF> points(mesh.lattice(level).point_count);
  for (std::size_t triangle = 0; triangle < mesh.triangle_count(); ++triangle) {
    const std::vector<std::uint32_t> vertices = mesh.vertices_of(level, triangle);
    for (std::size_t point = 0; point < points.size(); ++point) {
      const float* p = &positions[3 * std::size_t{vertices[point]}];
      points[point] = {p[0], p[1], p[2]};
    }
    raise_heights(mesh, points, heights);
  }
  return heights;
}

}  // namespace zerotree::surface
