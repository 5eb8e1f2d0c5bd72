// The encoding stage: from a wavelet decomposition to a stream.
#pragma once

#include <cstdint>
#include <vector>

#include "analysis/wavelet_decomposition.h"
#include "bitstream/base_topology.h"
#include "bitstream/coefficient_layout.h"
#include "encode/stream_encoder.h"
#include "surface/subdivision_hierarchy.h"
#include "surface/wavelet_transform.h"

namespace zerotree::encode {

struct EncodeOptions {
  /// Quantisation step of a normal detail of the finest level, in the unit of the input. Details of
  /// coarser levels have a step shorter by their basis function's norm. The stream holds eight
  /// bits of its digits: it is rounded down by up to 0.8 %.
  double finest_step = 0.0;
  /// Tangential details have a step 2^this times as long: 2 for scans, 3 for CAD-like models.
  int tangent_ratio_log2 = 2;
  /// The stream carries its base mesh (.zt); otherwise it is bound to an external one (glTF).
  bool embed_base = true;
  /// Bits per coordinate of an embedded base; 0 chooses so many that the error of the base, which
  /// its basis functions spread widely, weighs about as much as that of the details.
  int base_position_bits = 0;
  /// The transform that `decomposition` was made with; a hierarchy at hand has its own.
  surface::WaveletTransform transform = surface::WaveletTransform::loop_local;
};

struct EncodedStream {
  std::vector<std::uint8_t> bytes;
  /// As a decoder of all bytes has them.
  bitstream::CoefficientSet coefficients;
  /// x, y, z per base vertex, as a decoder of all bytes has them or, for an external base, as the
  /// accessors must hold them.
  std::vector<float> base_positions;
  /// In the order of the stream.
  std::vector<PassEnd> pass_ends;
};

/// Quantises and codes a decomposition over `hierarchy`. An embedded base must be in canonical
/// order (bitstream::canonical_base_order). Deterministic. Throws Error: refused_topology for a
/// base that cannot be coded, target_not_reachable for a step too small for the format, usage for a
/// step that is not positive.
EncodedStream encode(const surface::SubdivisionHierarchy& hierarchy,
                     const analysis::WaveletDecomposition& decomposition,
                     const EncodeOptions& options);

/// The same for a base whose hierarchy is not at hand.
EncodedStream encode(const bitstream::BaseTopology& base,
                     const analysis::WaveletDecomposition& decomposition,
                     const EncodeOptions& options);

}  // namespace zerotree::encode
