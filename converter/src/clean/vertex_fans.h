// Gives each fan of faces its own vertex and each sheet its own edge, so that indices alone say
// which faces are neighbours.
#pragma once

#include <cstdint>
#include <vector>

#include "clean/index_repairs.h"

namespace zerotree::clean {

/// A vertex at which several fans meet, as `mates` connects the faces, is doubled for each further
/// fan. Returns how many vertices were added. Linear.
std::uint64_t split_vertex_fans(WorkingMesh& mesh, const std::vector<std::uint32_t>& mates);

/// An edge at which several sheets meet although both its ends are common to them (a surface that
/// touches itself along an edge) is kept by one sheet and divided at its midpoint in the others.
/// No point of the surface changes. `mates` grows along. Returns how many edges were divided.
std::uint64_t divide_shared_edges(WorkingMesh& mesh, std::vector<std::uint32_t>& mates);

}  // namespace zerotree::clean
