// Greedy half-edge collapses down to a base mesh.
#pragma once

#include <cstdint>
#include <vector>

#include "domain/domain.h"

namespace zerotree::domain {

/// Collapses the cheapest vertices of `domain.topology` until `target` vertices are left or no
/// collapse is allowed, after those that `domain.collapses` has already, and adds them there.
/// Vertices of `pinned` are not removed. O(n log n).
void decimate(Domain& domain, const std::vector<std::uint32_t>& pinned, std::uint32_t target,
              const Progress& progress);

/// Of each face of the mesh: 1 if a collapse removed it.
std::vector<std::uint8_t> mark_removed_faces(const Domain& domain);

}  // namespace zerotree::domain
