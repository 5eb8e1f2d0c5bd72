// An order of vertices and faces in which neighbours in space are neighbours in memory.
#pragma once

#include "mesh/triangle_mesh.h"

namespace zerotree::clean {

/// Numbers the vertices anew along a space-filling curve (Morton's, 1024 cells along the longest
/// side of the bounding box; within a cell they keep their order) and the faces by their lowest
/// vertex. The surface stays the same. All that walks over the mesh afterwards finds what it needs
/// in the cache: scans come in the order of their scan lines, or in none. O(n log n), 40 bytes a
/// vertex in passing.
void sort_spatially(TriangleMesh& mesh);

}  // namespace zerotree::clean
