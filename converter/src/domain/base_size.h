// How many vertices a base mesh needs.
#pragma once

#include "domain/domain.h"

namespace zerotree::domain {

/// Components, boundary loops and total genus of the mesh, into `report`.
void count_topology(const TriangleTopology& topology, DomainReport& report);

/// The base size for `vertices` input vertices if none is asked for: one in 240, but enough for
/// every component, loop, handle and corner that `report` counts.
std::uint32_t automatic_base_size(std::uint32_t vertices, const DomainReport& report);

}  // namespace zerotree::domain
