// Small independent parts of the fitted surface around some of its faces.
#pragma once

#include <cstdint>
#include <vector>

#include "fit/limit_operator.h"
#include "relax/subdivided_levels.h"

namespace zerotree::fit {

/// Some control points that may move, and every face whose limit positions they move. Indices count
/// within the patch.
struct UntanglingPatch {
  /// The weight of a free control point in a limit position.
  struct Weight {
    std::uint32_t vertex, control;
    double weight;
  };
  /// The vertices of the faces: first those whose control points are free, then the others whose
  /// limit positions they move, then those at rest, which other patches may have too.
  std::vector<std::uint32_t> vertices;
  std::uint32_t free_count = 0, moving_count = 0;
  std::vector<Triangle> faces;
  std::vector<Weight> weights;
};

/// The parts around the given faces: free are their corners and the vertices within `rings` rings,
/// but those on features or `held`. Parts that have a moving vertex of a face in common are one.
/// O(faces) a ring.
std::vector<UntanglingPatch> untangling_patches(const relax::SubdividedLevel& finest,
                                                const LimitOperator& limit,
                                                const std::vector<std::uint8_t>& held,
                                                const std::vector<std::uint32_t>& faces, int rings);

}  // namespace zerotree::fit
