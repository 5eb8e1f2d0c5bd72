// The base shapes in the form the surface room takes.
#pragma once

#include <vector>

#include "bitstream/base_topology.h"
#include "shapes.h"
#include "surface/surface_synthesis.h"
#include "transforms.h"

namespace zerotree::test {

inline bitstream::BaseTopology topology_of(const Shape& shape) {
  return {static_cast<std::uint32_t>(shape.mesh.positions.size()), shape.mesh.triangles,
          shape.crease_edges, shape.corner_vertices};
}

inline surface::Positions positions_of(const TriangleMesh& mesh) {
  surface::Positions positions;
  for (const Eigen::Vector3d& p : mesh.positions)
    for (int axis = 0; axis < 3; ++axis) positions.push_back(static_cast<float>(p[axis]));
  return positions;
}

/// The control points of level `level` of the undisturbed Loop surface.
inline surface::Positions subdivided(const surface::SubdivisionHierarchy& hierarchy,
                                     surface::Positions points, int level) {
  for (int number = 0; number < level; ++number)
    points = surface::subdivide(hierarchy.level(number), points);
  return points;
}

inline Eigen::Vector3d point_at(const surface::Positions& positions, std::size_t vertex) {
  return {positions[3 * vertex], positions[3 * vertex + 1], positions[3 * vertex + 2]};
}

/// Appends the midpoints of the level's edges: the places of its odd vertices if nothing is curved.
inline void append_midpoints(const surface::SubdivisionLevel& level,
                             std::vector<Eigen::Vector3d>& flat) {
  for (const auto& [tail, head] : level.edges.vertices)
    flat.push_back(0.5 * (flat[tail] + flat[head]));
}

/// The face planes of the shape "cube" that go through `point`, as bits; its coordinates are 0 and
/// 1.
inline unsigned cube_planes(const Eigen::Vector3d& point) {
  unsigned bits = 0;
  for (int axis = 0; axis < 3; ++axis) {
    bits |= point[axis] == 0.0 ? 1u << axis : 0u;
    bits |= point[axis] == 1.0 ? 8u << axis : 0u;
  }
  return bits;
}

}  // namespace zerotree::test
