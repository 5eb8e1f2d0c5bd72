// The levels of a quadrisected base mesh: which vertices are neighbours, which were edges.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "bitstream/base_topology.h"
#include "mesh/triangle_mesh.h"

namespace zerotree::relax {

/// One level, numbered as remesh::SemiRegularMesh says: vertex V + e of the next level is the
/// midpoint of edge e of this one.
struct SubdividedLevel {
  std::uint32_t vertex_count = 0;
  std::vector<Triangle> triangles;
  /// Of each face its edges: edge k runs from corner k to k + 1.
  std::vector<Triangle> face_edges;
  /// Of each edge its two ends.
  std::vector<std::array<std::uint32_t, 2>> edges;
  /// Of each edge whether it is a piece of a crease or of the boundary.
  std::vector<std::uint8_t> is_feature;
};

/// Levels 0 .. `levels` of `base`. About 70 bytes a vertex of the finest level.
std::vector<SubdividedLevel> subdivide_base(const bitstream::BaseTopology& base, int levels);

}  // namespace zerotree::relax
