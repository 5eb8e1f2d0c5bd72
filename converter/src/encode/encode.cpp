#include "encode/encode.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "bitstream/base_hash.h"
#include "encode/base_quantisation.h"
#include "encode/detail_quantisation.h"
#include "encode/header_writer.h"
#include "mesh/error.h"
#include "surface/detail_weights.h"
#include "surface/subdivision_hierarchy.h"

namespace zerotree::encode {
namespace {

// The paper sends four planes of the base first and then one per plane of details.
constexpr int kFewestInitialPlanes = 4;

// Length of a base coordinate's integer over the step that its basis norm asks for. Longer, because
// two thirds of a control point's error are tangential, where details have longer steps too.
// Measured on four scans: half of it costs 0.1 dB more at 1/4 bit per vertex.
constexpr double kBaseUnit = 2.8;

void check_options(const EncodeOptions& options) {
  const float step = storable_step(options.finest_step);
  if (!(step > 0.0f) || !std::isfinite(step)) {
    throw Error(ExitCode::usage, "the quantisation step must be a positive number");
  }
  if (options.tangent_ratio_log2 < 0 ||
      options.tangent_ratio_log2 > bitstream::kMostTangentRatioLog2) {
    throw Error(ExitCode::usage, "the tangential step ratio must be 2^0 to 2^15");
  }
  if (options.base_position_bits < 0 || options.base_position_bits > bitstream::kMostPositionBits) {
    throw Error(ExitCode::usage, "base positions have 1 to 28 bits, or 0 to choose");
  }
}

std::vector<float> single_precision(const std::vector<Eigen::Vector3d>& positions) {
  std::vector<float> result;
  result.reserve(positions.size() * 3);
  for (const Eigen::Vector3d& p : positions) {
    for (int axis = 0; axis < 3; ++axis) result.push_back(static_cast<float>(p[axis]));
  }
  return result;
}

surface::SubdivisionHierarchy hierarchy_of(const bitstream::BaseTopology& base, int levels,
                                           surface::WaveletTransform transform) {
  try {
    return surface::SubdivisionHierarchy(base, levels, transform);
  } catch (const std::invalid_argument& problem) {
    throw Error(ExitCode::refused_topology,
                std::string("cannot subdivide the base mesh: ") + problem.what());
  }
}

}  // namespace

EncodedStream encode(const bitstream::BaseTopology& base,
                     const analysis::WaveletDecomposition& decomposition,
                     const EncodeOptions& options) {
  const int levels = static_cast<int>(decomposition.details.size());
  return encode(hierarchy_of(base, levels, options.transform), decomposition, options);
}

EncodedStream encode(const surface::SubdivisionHierarchy& hierarchy,
                     const analysis::WaveletDecomposition& decomposition,
                     const EncodeOptions& options) {
  check_options(options);
  const bitstream::BaseTopology& base = hierarchy.base();
  const int levels = hierarchy.levels();
  if (decomposition.base_control_points.size() != base.vertex_count ||
      decomposition.details.size() != static_cast<std::size_t>(levels)) {
    throw Error(ExitCode::refused_topology, "the base mesh lacks positions or levels of details");
  }

  StreamContent content;
  content.base = base;
  bitstream::StreamHeader& header = content.header;
  header.external_base = !options.embed_base;
  header.transform = static_cast<std::uint32_t>(hierarchy.transform());
  header.levels = levels;
  header.finest_step = storable_step(options.finest_step);
  header.tangent_ratio_log2 = options.tangent_ratio_log2;

  EncodedStream result;
  if (options.embed_base) {
    // Moving a base vertex is much like a detail one level above the coarsest.
    const double norm = double{surface::basis_norm(levels)};
    QuantisedBase quantised =
        quantise_base(decomposition.base_control_points, options.base_position_bits,
                      kBaseUnit * double{header.finest_step} / norm, header.finest_step);
    header.positions = quantised.quantisation;
    content.positions = std::move(quantised.integers);
    result.base_positions = std::move(quantised.positions);
  } else {
    result.base_positions = single_precision(decomposition.base_control_points);
    header.base_hash = bitstream::hash_base(base, result.base_positions);
  }

  const surface::Dequantisation dequantisation{
      header.finest_step, static_cast<float>(1u << options.tangent_ratio_log2)};
  content.coefficients =
      quantise_details(hierarchy, decomposition, dequantisation, result.base_positions);
  if (options.embed_base) {
    const int bits = header.positions.bits;
    header.positions.initial_planes =
        std::min(bits, std::max(kFewestInitialPlanes, bits - count_planes(content.coefficients)));
  }
  StreamBytes stream = encode_stream(content);
  result.bytes = std::move(stream.bytes);
  result.pass_ends = std::move(stream.pass_ends);
  result.coefficients = std::move(content.coefficients);
  return result;
}

}  // namespace zerotree::encode
