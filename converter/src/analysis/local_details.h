// Details as they look from the surface they lie on.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "analysis/wavelet_decomposition.h"
#include "surface/subdivision_hierarchy.h"

namespace zerotree::analysis {

/// The details of each level and edge as (normal, tangent 1, tangent 2) in the local frames of the
/// coarser level's surface (paper, section 3.3).
std::vector<std::vector<Eigen::Vector3d>> local_details(
    const surface::SubdivisionHierarchy& hierarchy, const WaveletDecomposition& decomposition);

}  // namespace zerotree::analysis
