// Decides which faces are neighbours, also where more than two meet at an edge.
#pragma once

#include <cstdint>
#include <vector>

#include "clean/index_repairs.h"
#include "clean/orientation.h"

namespace zerotree::clean {

struct FacePairing {
  /// Per half-edge that of the neighbour, no_half_edge where there is none. Neighbours may still be
  /// turned against each other, as `forest` knows.
  std::vector<std::uint32_t> mates;
  OrientationForest forest;
  /// Edges at which more than two faces meet.
  std::uint64_t non_manifold_edges = 0;
};

/// Faces at an edge of two are neighbours; throws Error(refused_topology) if that makes a one-sided
/// surface. Where more meet, the pairs that agree with the file's orientation come first, and of
/// these the flattest; a pair that would make the surface one-sided is not made.
FacePairing pair_faces(const WorkingMesh& mesh);

}  // namespace zerotree::clean
