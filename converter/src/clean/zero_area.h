// Gets rid of triangles of no area without tearing the surface.
#pragma once

#include <cstdint>
#include <vector>

#include "clean/clean_mesh.h"
#include "clean/index_repairs.h"

namespace zerotree::clean {

struct ZeroAreaCounts {
  std::uint64_t flipped_edges = 0;
  std::uint64_t removed_faces = 0;
  std::uint64_t nudged_vertices = 0;
};

/// Takes an oriented manifold with its mates. The longest edge of a triangle of no area is flipped
/// (its third corner lies on that edge, so the surface stays the same set of points); at a boundary
/// the triangle is removed; where the flip is impossible the corner is moved by options.nudge.
/// Afterwards vertices may have several fans or no face, and `mates` is out of date.
ZeroAreaCounts repair_zero_area(WorkingMesh& mesh, std::vector<std::uint32_t> mates,
                                const CleanOptions& options);

}  // namespace zerotree::clean
