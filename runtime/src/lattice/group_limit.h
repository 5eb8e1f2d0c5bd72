// Limit positions and normals inside base triangles, kLanes of them at once.
#pragma once

#include <cstddef>

#include "lattice/lanes.h"
#include "lattice/lattice_mesh.h"
#include "surface/limit_output.h"

namespace zerotree::surface {

/// Writes those of the vertices inside the triangles of `group` at `level`, whose points these are.
void write_limits_inside(const LatticeMesh& mesh, int level, std::size_t group,
                         const LanePoint* points, const LimitOutput& output);

}  // namespace zerotree::surface
