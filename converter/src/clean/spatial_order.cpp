#include "clean/spatial_order.h"

#include <algorithm>
#include <cstdint>
#include <numeric>

namespace zerotree::clean {
namespace {

constexpr int kBitsPerAxis = 10;

// Moves bit i of ten bits to bit 3 i.
std::uint64_t spread_bits(std::uint64_t bits) {
  bits = (bits | (bits << 16)) & 0x030000ff;
  bits = (bits | (bits << 8)) & 0x0300f00f;
  bits = (bits | (bits << 4)) & 0x030c30c3;
  return (bits | (bits << 2)) & 0x09249249;
}

// The vertices in the order of their cells on Morton's curve.
std::vector<std::uint32_t> order_of(const std::vector<Eigen::Vector3d>& positions) {
  Eigen::Vector3d low = positions.front(), high = low;
  for (const Eigen::Vector3d& p : positions) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  constexpr double last_cell = (1 << kBitsPerAxis) - 1;
  const double side = (high - low).maxCoeff();
  const double scale = side > 0 ? last_cell / side : 0;
  // The cell in the upper half, the vertex in the lower.
  std::vector<std::uint64_t> keys(positions.size());
  for (std::size_t v = 0; v < keys.size(); ++v) {
    std::uint64_t code = 0;
    for (int axis = 0; axis < 3; ++axis)
      code |= spread_bits(static_cast<std::uint64_t>((positions[v][axis] - low[axis]) * scale))
              << axis;
    keys[v] = (code << 32) | v;
  }
  std::ranges::sort(keys);
  std::vector<std::uint32_t> order(keys.size());
  std::ranges::transform(keys, order.begin(),
                         [](std::uint64_t key) { return static_cast<std::uint32_t>(key); });
  return order;
}

// By counting: the order of the faces of one vertex stays.
void sort_faces_by_lowest_vertex(std::size_t vertex_count, std::vector<Triangle>& triangles) {
  std::vector<std::uint32_t> next(vertex_count + 1, 0);
  for (const Triangle& t : triangles) ++next[std::ranges::min(t) + 1];
  std::partial_sum(next.begin(), next.end(), next.begin());
  std::vector<Triangle> sorted(triangles.size());
  for (const Triangle& t : triangles) sorted[next[std::ranges::min(t)]++] = t;
  triangles.swap(sorted);
}

}  // namespace

void sort_spatially(TriangleMesh& mesh) {
  if (mesh.positions.empty()) return;
  {
    const std::vector<std::uint32_t> order = order_of(mesh.positions);
    std::vector<Eigen::Vector3d> positions(order.size());
    std::vector<std::uint32_t> renamed(order.size());
    for (std::uint32_t v = 0; v < order.size(); ++v) {
      positions[v] = mesh.positions[order[v]];
      renamed[order[v]] = v;
    }
    mesh.positions.swap(positions);
    for (Triangle& t : mesh.triangles)
      for (std::uint32_t& v : t) v = renamed[v];
  }
  sort_faces_by_lowest_vertex(mesh.positions.size(), mesh.triangles);
}

}  // namespace zerotree::clean
