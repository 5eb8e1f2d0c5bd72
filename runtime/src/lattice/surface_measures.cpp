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

float length(const PointF& p) {
  return std::sqrt(p.x * p.x + p.y * p.y + p.z * p.z);
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

float longest_step(const LatticeMesh& mesh, int level, std::span<const float> coarse,
                   std::span<const float> fine) {
  const LatticeLevel& lattice = mesh.lattice(level);
  const LatticeLevel& finer = mesh.lattice(level + 1);
  const auto point = [](std::span<const float> positions, std::uint32_t vertex) {
    const float* p = &positions[3 * std::size_t{vertex}];
    return PointF{p[0], p[1], p[2]};
  };
  float longest = 0.0f;
  for (std::uint32_t vertex = 0; 3 * std::size_t{vertex} < coarse.size(); ++vertex)
    longest = std::max(longest, length(point(fine, vertex) - point(coarse, vertex)));
  for (std::size_t triangle = 0; triangle < mesh.triangle_count(); ++triangle) {
    const std::vector<std::uint32_t> vertices = mesh.vertices_of(level + 1, triangle);
    // Points keep their numbers at finer levels.
    const auto include = [&](std::uint32_t odd, std::uint32_t tail, std::uint32_t head) {
      const PointF ends = point(coarse, vertices[tail]) + point(coarse, vertices[head]);
      longest = std::max(longest, length(point(fine, vertices[odd]) - 0.5f * ends));
    };
    for (const auto& edges : lattice.edges)
      for (const LatticeEdge& edge : edges) include(edge.odd, edge.tail, edge.head);
    for (const auto& side : finer.side_points)
      for (std::size_t i = 1; i < side.size(); i += 2) include(side[i], side[i - 1], side[i + 1]);
  }
  return longest;
}

}  // namespace zerotree::surface
