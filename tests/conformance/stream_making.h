// From a shape and some numbers to a stream. Integers are made directly, not by analysis, so that
// streams do not depend on the rounding of floats.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "conformance_cases.h"
#include "encode/stream_encoder.h"
#include "shapes.h"
#include "surface/wavelet_transform.h"

namespace zerotree::conformance {

struct StreamPlan {
  int levels = 2;
  surface::WaveletTransform transform = surface::WaveletTransform::loop_local;
  double finest_step = 0x1p-9;
  int tangent_ratio_log2 = 2;
  int position_bits = 10;  ///< embedded base only
  int initial_planes = 4;  ///< embedded base only
  /// Per level: magnitudes of details are below 2^this, small ones more often; 0: no details.
  std::vector<int> detail_bits{};
  int per_mille = 500;  ///< share of the cells that get a detail
  std::uint32_t seed = 1;
};

/// `shape` in canonical order, its positions in an embedded base.
encode::StreamContent embedded_content(const test::Shape& shape, const StreamPlan& plan);

/// `shape` as it is, as an external base of the name of the shape.
Base external_base(const test::Shape& shape);
/// A stream bound to it, with the shape's tags.
encode::StreamContent external_content(const test::Shape& shape, const StreamPlan& plan);

/// Which prefixes are decoded, besides the whole stream.
enum class Cuts {
  every,  ///< all awkward places
  some,   ///< a few, and one byte short
  half,   ///< half of it
  whole,  ///< none
};

/// Codes the content; `shape` is needed for an external base only.
StreamCase make_case(std::string name, std::vector<std::string> shows,
                     const encode::StreamContent& content, Cuts cuts,
                     const test::Shape* shape = nullptr);

}  // namespace zerotree::conformance
