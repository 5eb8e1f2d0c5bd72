// Laying a mesh out over its base: the collapses undone on the base surface.
#pragma once

#include <cstddef>
#include <cstdint>

#include "domain/coarse_domain.h"
#include "domain/domain.h"
#include "mesh/progress.h"
#include "remesh/base_domain.h"
#include "remesh/cone_charts.h"

namespace zerotree::remesh {

/// A bijection between a domain's mesh and its base surface.
struct Parameterisation {
  BaseDomain base;
  ConeCharts charts;
  std::uint32_t cone_swaps = 0;
  /// The collapse whose undo found no room, counted from 1 in their order; 0 if all is well.
  std::size_t stuck = 0;
};

/// Undoes the collapses of `domain` on its base surface, relaxing as the mesh grows.
/// Cost: about 5 microseconds and 140 bytes a vertex; the most of it on all threads of oneTBB.
Parameterisation parameterise(const domain::Domain& domain, const Progress& progress);

/// The same for `fine` from a coarse version of it on that is laid out already: the first collapses
/// of `fine`, which `coarse` does not have, are undone.
Parameterisation refine(const domain::Domain& fine, const domain::CoarseDomain& coarse,
                        const Parameterisation& laid_out, const Progress& progress);

}  // namespace zerotree::remesh
