// From the domain of a scan to a parameterisation over its base mesh.
#pragma once

#include <cstdint>

#include "domain/base_size.h"
#include "domain/domain.h"
#include "mesh/progress.h"
#include "remesh/bijectivity.h"
#include "remesh/parameterisation.h"

namespace zerotree::remesh {

struct RemeshOptions {
  /// Subdivision levels; -1: from the input's density and `goal` (domain/base_size.h).
  int levels = -1;
  domain::AccuracyGoal goal = {};
};

struct RemeshReport {
  std::uint32_t base_vertices = 0;
  std::uint32_t base_faces = 0;
  std::uint32_t base_crease_edges = 0;
  std::uint32_t base_corners = 0;
  std::uint32_t min_valence = 0;
  std::uint32_t max_valence = 0;
  int levels = 0;
  std::uint32_t finest_vertices = 0;
  /// Vertices kept in the base because a limb would have been squeezed without them.
  std::uint32_t pinned_limbs = 0;
  /// How often a re-inserted vertex took the place of a base vertex.
  std::uint32_t cone_swaps = 0;
  /// How often the undo found no room and the base was built again with that vertex in it.
  std::uint32_t rebuilds = 0;
  /// Of the parameterisation; both 0 (up to 1e-9) in every result.
  BijectivityReport bijectivity;
};

struct RemeshResult {
  Parameterisation laid_out;
  RemeshReport report;
};

/// Parameterises `domain` over its base mesh, which is in the order of the stream's connectivity
/// coder, and chooses the depth of its subdivision.
/// Throws Error(refused_topology) if no base was found over which the mesh can be laid out,
/// Error(usage) if `levels` makes more than 2^30 vertices.
/// Cost: about 7 microseconds and 160 bytes per input vertex; half of it on all threads of oneTBB.
RemeshResult remesh(const domain::Domain& domain, const RemeshOptions& options,
                    const Progress& progress);

}  // namespace zerotree::remesh
