// Whether the parameterisation covers the base surface exactly once.
#pragma once

#include "remesh/cone_charts.h"

namespace zerotree::remesh {

struct BijectivityReport {
  /// Faces that are not positively oriented in the domain.
  std::uint32_t flipped_faces = 0;
  /// Largest deviation of the area that faces cover in a base triangle from the triangle's own,
  /// as a share of it. Together with no flipped face: 0 means bijective.
  double worst_coverage = 0;
};

/// Clips every face to the base triangles it lies in. O(n).
BijectivityReport check_bijectivity(const ConeCharts& charts, const BaseDomain& base);

}  // namespace zerotree::remesh
