// Tagged base meshes and vectors over their vertices.
#pragma once

#include <algorithm>
#include <random>

#include "bitstream/base_topology.h"
#include "fit/limit_operator.h"
#include "shapes.h"

namespace zerotree::test {

inline bitstream::BaseTopology topology_of(const Shape& shape) {
  return {static_cast<std::uint32_t>(shape.mesh.positions.size()), shape.mesh.triangles,
          shape.crease_edges, shape.corner_vertices};
}

/// The base shapes, and grids whose tags are of every kind: a crease from boundary to boundary, one
/// that ends inside (a dart) or turns sharply, corners on curves, on the boundary and on their own.
inline std::vector<Shape> tagged_shapes() {
  std::vector<Shape> shapes = base_shapes();
  shapes.push_back({"triangle", {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}, {}, {}});
  // Vertex 7 y + x lies at (x, y).
  Shape crossed{"crossed", grid(6, 4), {}, {}};
  for (std::uint32_t y = 0; y < 4; ++y) crossed.crease_edges.push_back({7 * y + 3, 7 * y + 10});
  shapes.push_back(crossed);
  crossed.name = "crossed_with_corners";
  crossed.corner_vertices = {0, 3, 6, 17, 22, 28, 31, 34};
  shapes.push_back(crossed);
  shapes.push_back({"dart", grid(6, 4), {{15, 16}, {16, 17}}, {15}});
  shapes.push_back({"bend", grid(6, 4), {{15, 16}, {16, 23}}, {16}});
  return shapes;
}

/// Points of a cube of side 2 about the origin, the same on every machine.
inline fit::Points random_points(std::size_t count, std::uint32_t seed) {
  std::mt19937 random(seed);
  fit::Points points(count);
  for (Eigen::Vector3d& p : points)
    for (int axis = 0; axis < 3; ++axis) p[axis] = static_cast<double>(random()) * 0x1p-31 - 1;
  return points;
}

inline double dot(const fit::Points& a, const fit::Points& b) {
  double sum = 0;
  for (std::size_t v = 0; v < a.size(); ++v) sum += a[v].dot(b[v]);
  return sum;
}

}  // namespace zerotree::test
