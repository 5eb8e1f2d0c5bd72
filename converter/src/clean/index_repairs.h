// Repairs that need no adjacency: welding, degenerate and duplicate faces, unreferenced vertices.
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/triangle_mesh.h"

namespace zerotree::clean {

/// A mesh under repair.
struct WorkingMesh {
  std::vector<Eigen::Vector3d> positions;
  std::vector<Triangle> triangles;
  /// Per vertex the input's vertex.
  std::vector<std::uint32_t> source_vertex;
  /// Per face the input's face, for messages.
  std::vector<std::uint32_t> source_face;
};

/// Throws Error(unreadable_input) if a position is not finite, or so large that volumes are not,
/// or an index is out of range.
void check_input(const TriangleMesh& input);

/// Lets all faces name the first of several vertices at exactly the same place (0 equals -0).
/// Returns how many vertices are no longer named for that.
std::uint64_t weld_equal_positions(WorkingMesh& mesh);

/// Removes faces that name a vertex twice; returns their number.
std::uint64_t drop_degenerate_faces(WorkingMesh& mesh);

/// Keeps the first of several faces with the same three vertices, whichever way they are turned;
/// returns how many went. `folded` gets 1 per kept face that had as many copies of either
/// orientation: a two-sided face, or a fold that welding has pressed flat.
std::uint64_t drop_duplicate_faces(WorkingMesh& mesh, std::vector<std::uint8_t>& folded);

/// Removes a folded face where the surface goes on without it: some of its edges has two or more
/// other faces, and none has exactly one. Returns how many went.
std::uint64_t drop_folded_faces(WorkingMesh& mesh, const std::vector<std::uint8_t>& folded);

/// Removes vertices that no face names; the others keep their order. Returns how many went.
std::uint64_t drop_unreferenced_vertices(WorkingMesh& mesh);

}  // namespace zerotree::clean
