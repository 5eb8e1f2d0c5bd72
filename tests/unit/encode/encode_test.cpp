// Quantisation: what the decoder makes of the stream is close to what went in.
#include "encode/encode.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "bitstream/base_traversal.h"
#include "bitstream/stream_decoder.h"
#include "mesh/error.h"
#include "shapes.h"
#include "surface/detail_weights.h"
#include "surface/subdivision_hierarchy.h"

namespace zerotree {
namespace {

struct Input {
  bitstream::BaseTopology base;
  analysis::WaveletDecomposition decomposition;
};

Input random_input(const test::Shape& shape, int levels) {
  Input input;
  const bitstream::BaseTopology base{static_cast<std::uint32_t>(shape.mesh.positions.size()),
                                     shape.mesh.triangles, shape.crease_edges,
                                     shape.corner_vertices};
  const bitstream::BaseOrder order = bitstream::canonical_base_order(base);
  input.base = bitstream::reorder(base, order);
  for (const std::uint32_t old : order.vertices) {
    input.decomposition.base_control_points.push_back(shape.mesh.positions[old]);
  }
  const surface::SubdivisionHierarchy hierarchy(input.base, levels, {});
  std::mt19937 random(3);
  const auto uniform = [&] { return static_cast<double>(random()) * 0x1p-31 - 1.0; };
  for (int level = 0; level < levels; ++level) {
    const double size = 0.02 * std::pow(0.3, level);
    auto& details = input.decomposition.details.emplace_back(hierarchy.level(level).edge_count);
    for (Eigen::Vector3d& d : details) d = size * Eigen::Vector3d(uniform(), uniform(), uniform());
  }
  return input;
}

TEST(Encode, DetailsComeBackWithinTheirStep) {
  for (const test::Shape& shape : test::base_shapes()) {
    const Input input = random_input(shape, 3);
    encode::EncodeOptions options;
    options.finest_step = 1e-4;
    const encode::EncodedStream stream = encode::encode(input.base, input.decomposition, options);
    bitstream::StreamDecoder decoder;
    ASSERT_EQ(decoder.feed(stream.bytes), bitstream::DecodeStatus::done) << decoder.reason();
    EXPECT_EQ(decoder.coefficients().channels, stream.coefficients.channels);
    EXPECT_EQ(decoder.base_positions(), stream.base_positions);

    const surface::SubdivisionHierarchy hierarchy(input.base, 3, options.transform);
    const auto weights =
        surface::base_edge_weights(input.base, hierarchy.base_edges(), decoder.base_positions());
    const surface::Dequantisation dequantisation{options.transform, decoder.header().finest_step,
                                                 4.0f};
    std::size_t details = 0;
    for (int level = 0; level < 3; ++level) {
      const auto& cell_to_edge = hierarchy.level(level).edges.cell_to_edge;
      const std::size_t begin = bitstream::level_offset(weights.size(), level);
      for (std::size_t i = 0; i < cell_to_edge.size(); ++i) {
        if (cell_to_edge[i] == bitstream::kNone) continue;
        ++details;
        for (int c = 0; c < 3; ++c) {
          const double unit = double{surface::detail_unit(dequantisation, 3, level,
                                                          static_cast<bitstream::Channel>(c),
                                                          weights[i >> (2 * level)])};
          const double value = 0.5 * unit * decoder.coefficients().channels[c][begin + i];
          const double truth = input.decomposition.details[level][cell_to_edge[i]][c];
          // Half a step, or a whole one in the dead zone.
          ASSERT_LE(std::abs(value - truth), unit * (value == 0.0 ? 1.0 : 0.5001)) << shape.name;
        }
      }
    }
    EXPECT_EQ(details, hierarchy.level(0).edge_count + hierarchy.level(1).edge_count +
                           hierarchy.level(2).edge_count);
  }
}

TEST(Encode, BaseErrorStaysNearTheStep) {
  const Input input = random_input(test::base_shapes().front(), 3);
  encode::EncodeOptions options;
  options.finest_step = 1e-3;
  const encode::EncodedStream stream = encode::encode(input.base, input.decomposition, options);
  const double norm = double{surface::basis_norm(options.transform, 3)};
  for (std::size_t v = 0; v < input.base.vertex_count; ++v) {
    for (int axis = 0; axis < 3; ++axis) {
      const double error = double{stream.base_positions[3 * v + axis]} -
                           input.decomposition.base_control_points[v][axis];
      EXPECT_LE(std::abs(error), 0.51 * 1.4 * options.finest_step / norm);
    }
  }
}

TEST(Encode, ExternalBaseIsBoundToItsPositions) {
  const Input input = random_input(test::base_shapes()[2], 2);
  encode::EncodeOptions options;
  options.finest_step = 1e-3;
  options.embed_base = false;
  const encode::EncodedStream stream = encode::encode(input.base, input.decomposition, options);
  bitstream::BaseTopology untagged = input.base;
  untagged.crease_edges.clear();
  untagged.corner_vertices.clear();
  bitstream::StreamDecoder decoder(untagged, stream.base_positions);
  ASSERT_EQ(decoder.feed(stream.bytes), bitstream::DecodeStatus::done) << decoder.reason();
  EXPECT_EQ(decoder.base().crease_edges, input.base.crease_edges);
  EXPECT_EQ(decoder.base().corner_vertices, input.base.corner_vertices);
  EXPECT_EQ(decoder.coefficients().channels, stream.coefficients.channels);
}

ExitCode refusal(const Input& input, const encode::EncodeOptions& options) {
  try {
    encode::encode(input.base, input.decomposition, options);
  } catch (const Error& error) {
    return error.code();
  }
  return ExitCode::done;
}

TEST(Encode, RefusesStepsThatDoNotWork) {
  const Input input = random_input(test::base_shapes().front(), 2);
  encode::EncodeOptions options;
  EXPECT_EQ(refusal(input, options), ExitCode::usage);
  options.finest_step = 1e-12;
  EXPECT_EQ(refusal(input, options), ExitCode::target_not_reachable);
  options.embed_base = false;
  options.finest_step = 1e-13;
  EXPECT_EQ(refusal(input, options), ExitCode::target_not_reachable);
  options.finest_step = 1e-3;
  options.tangent_ratio_log2 = 16;
  EXPECT_EQ(refusal(input, options), ExitCode::usage);
}

TEST(Encode, RefusesPositionsThatAreNotFinite) {
  Input input = random_input(test::base_shapes().front(), 1);
  input.decomposition.base_control_points[3].x() = std::nan("");
  encode::EncodeOptions options;
  options.finest_step = 1e-3;
  EXPECT_EQ(refusal(input, options), ExitCode::refused_topology);
}

}  // namespace
}  // namespace zerotree
