// Faces, their neighbours and the fans around vertices: what collapses and their undo change.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mesh/triangle_mesh.h"

namespace zerotree::domain {

inline constexpr std::uint32_t kNone = 0xffffffffu;
/// The corner after and before a corner of a triangle, counter-clockwise.
inline constexpr std::array<int, 3> kNext{1, 2, 0};
inline constexpr std::array<int, 3> kPrev{2, 0, 1};

/// An oriented 2-manifold triangle mesh. Edge k of a face runs from its corner k to corner k + 1.
/// 25 bytes a face and 4 a vertex.
struct TriangleTopology {
  std::vector<Triangle> faces;
  /// The face across edge k, kNone on the boundary.
  std::vector<std::array<std::uint32_t, 3>> adjacent;
  /// Bit k: edge k is a crease. Boundary edges carry no bit.
  std::vector<std::uint8_t> creases;
  /// Any face of each vertex.
  std::vector<std::uint32_t> face_of_vertex;
};

/// A corner of a face.
struct Corner {
  std::uint32_t face;
  int corner;
};

/// The faces around a vertex, counter-clockwise, each with the corner that holds the vertex. An
/// open star begins and ends at the boundary. Meant to be reused: `corners` keeps its memory.
struct Star {
  std::vector<Corner> corners;
  bool closed = false;
};

/// Which corner of `face` holds `vertex`, which must be one of its vertices.
inline int corner_of(const Triangle& face, std::uint32_t vertex) {
  // Without a branch, which no processor could foresee.
  return static_cast<int>(face[1] == vertex) + 2 * static_cast<int>(face[2] == vertex);
}

/// Whether edge `k` of `face` is a crease or lies on the boundary.
inline bool is_feature(const TriangleTopology& topology, std::uint32_t face, int k) {
  return topology.adjacent[face][k] == kNone || ((topology.creases[face] >> k) & 1) != 0;
}

/// Which edge of `face` leads to the face `neighbour`, which must be one of its neighbours.
inline int edge_towards(const TriangleTopology& topology, std::uint32_t face,
                        std::uint32_t neighbour) {
  const auto& adjacent = topology.adjacent[face];
  return adjacent[0] == neighbour ? 0 : adjacent[1] == neighbour ? 1 : 2;
}

/// Neighbours of a clean mesh. Every vertex below `vertex_count` must have a face. Throws
/// Error(refused_topology) that names the place if an edge has more than two faces or two that
/// disagree in orientation, if faces meet in a vertex only, or a vertex has no face.
TriangleTopology build_topology(std::uint32_t vertex_count, const std::vector<Triangle>& faces);

/// The faces around `vertex` of `topology`, in the order of their corners.
void gather_star(const TriangleTopology& topology, std::uint32_t vertex, Star& star);

}  // namespace zerotree::domain
