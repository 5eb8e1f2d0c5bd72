// Which vertices features pass through, and which hold them.
#pragma once

#include <vector>

#include "domain/domain.h"

namespace zerotree::domain {

/// The kind of each vertex from the feature edges at it and the turn of the chain there: a corner
/// is a vertex with other than 0 or 2 feature edges, or where the chain turns sharply.
std::vector<VertexKind> classify_vertices(const TriangleMesh& mesh,
                                          const TriangleTopology& topology);

}  // namespace zerotree::domain
