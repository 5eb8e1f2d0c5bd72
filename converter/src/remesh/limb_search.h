// Finding the limbs that a base mesh has lost, before they cost resolution.
#pragma once

#include <cstdint>
#include <vector>

#include "remesh/parameterisation.h"

namespace zerotree::remesh {

/// How unevenly the surface is spread over its base, and where it is squeezed most.
struct SpreadReport {
  /// Mean over the surface of its area per area of the domain, in units of the mean of the whole:
  /// 1 where all is even, large where a limb lies squeezed in one base triangle.
  double energy = 1;
  /// Vertices amid squeezed surface, each in a base triangle of its own.
  std::vector<std::uint32_t> squeezed;
};

/// Looks at the parameterisation of `domain`. O(faces); names at most `most` vertices.
SpreadReport measure_spread(const domain::Domain& domain, const Parameterisation& laid_out,
                            std::size_t most);

/// Lays out `domain`, which should be a coarse version of the mesh, keeps the vertices of squeezed
/// limbs in the base, and tries again while that helps and the base has no more than
/// `most_base_faces`. Returns the vertices to pin, ascending; `domain` then has the base with them.
/// Cost: about 15 microseconds a vertex and round, of which there are up to 20.
std::vector<std::uint32_t> pin_limbs(domain::Domain& domain, std::size_t most_base_faces,
                                     const Progress& progress);

}  // namespace zerotree::remesh
