// The system that is left of a local filter's synthesis without its details.
#pragma once

#include <cstddef>

#include "analysis/synthesis_matrix.h"
#include "surface/subdivision_hierarchy.h"

namespace zerotree::analysis {

/// Calls visit(coarse vertex, weight) for each entry of `row` of P.
template <class Visit>
void for_each_tap(const surface::SubdivisionStencils& rows, std::size_t row, const Visit& visit) {
  for (int k = rows.offsets[row]; k < rows.offsets[row] + rows.sizes[row]; ++k) {
    const auto entry = static_cast<std::size_t>(k);
    visit(static_cast<std::size_t>(rows.indices[entry]), static_cast<double>(rows.weights[entry]));
  }
}

/// P_even + D P_odd of a level with a local filter (see split_by_elimination): square, one row and
/// one column per vertex, its entries in the vertex's ring.
SparseMatrix eliminated_matrix(const surface::SubdivisionLevel& level);

}  // namespace zerotree::analysis
