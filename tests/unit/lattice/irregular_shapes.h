// Base meshes with every sort of vertex that subdivision has rules for.
#pragma once

#include <vector>

#include "shapes.h"

namespace zerotree::test {

/// Creases in a circle through irregular vertices ("crease_circle"), ending in darts ("darts"),
/// meeting a boundary ("crease_to_boundary"), three and four at a vertex ("crease_star"), beside
/// tagged corners ("tagged_corners"); valences 3 to 12 in one mesh of several components
/// ("valences"); every vertex on one of two boundaries and beside the other ("open_ring"); a
/// vertex in a single triangle ("one_triangle"). No two edges have the same length.
std::vector<Shape> irregular_shapes();

}  // namespace zerotree::test
