// Integers for the details.
#pragma once

#include <span>

#include "analysis/wavelet_decomposition.h"
#include "bitstream/coefficient_layout.h"
#include "surface/detail_weights.h"
#include "surface/subdivision_hierarchy.h"

namespace zerotree::encode {

/// Expresses the details in the local frames of the coarser levels as a decoder of the whole stream
/// will have them, sorts them into the edge forest and truncates each to whole multiples of its
/// unit (surface::detail_unit over the area weight). The dead zone that truncation leaves around
/// zero is twice a step wide, which suits the details' peaked distribution (paper, section 3.3).
/// `base_positions` are those the decoder will have. Throws Error (target_not_reachable) if a
/// detail is 2^30 units or more or not finite. About 0.4 microseconds per finest vertex.
bitstream::CoefficientSet quantise_details(const surface::SubdivisionHierarchy& hierarchy,
                                           const analysis::WaveletDecomposition& decomposition,
                                           const surface::Dequantisation& dequantisation,
                                           std::span<const float> base_positions);

}  // namespace zerotree::encode
