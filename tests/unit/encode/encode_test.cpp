// Quantisation: what the decoder makes of the stream is close to what went in.
#include "encode/encode.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "bitstream/base_traversal.h"
#include "bitstream/stream_decoder.h"
#include "mesh/error.h"
#include "shapes.h"
#include "surface/detail_weights.h"
#include "surface/edge_frames.h"
#include "surface/subdivision_hierarchy.h"
#include "surface/surface_synthesis.h"
#include "transforms.h"

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
  const surface::SubdivisionHierarchy hierarchy(input.base, levels,
                                                encode::EncodeOptions{}.transform);
  std::mt19937 random(3);
  const auto uniform = [&] { return static_cast<double>(random()) * 0x1p-31 - 1.0; };
  for (int level = 0; level < levels; ++level) {
    const double size = 0.02 * std::pow(0.3, level);
    auto& details = input.decomposition.details.emplace_back(hierarchy.level(level).edge_count);
    for (Eigen::Vector3d& d : details) d = size * Eigen::Vector3d(uniform(), uniform(), uniform());
  }
  return input;
}

class EncodeWith : public testing::TestWithParam<surface::WaveletTransform> {};

// A detail's components in its frame, and how long an integer of each is.
struct LocalDetail {
  std::array<double, 3> components, units;
};

LocalDetail local_detail(const surface::EdgeTangents& tangents, double mean_area,
                         const surface::Dequantisation& dequantisation, int levels, int level,
                         const Eigen::Vector3d& detail) {
  const double weight = double{surface::area_weight(tangents.triangle_area(), mean_area)};
  LocalDetail local{tangents.frame().components({detail.x(), detail.y(), detail.z()}), {}};
  for (std::size_t c = 0; c < 3; ++c)
    local.units[c] =
        double{detail_unit(dequantisation, levels, level, static_cast<bitstream::Channel>(c))} /
        weight;
  return local;
}

// In the frames of the decoded surface: what quantisation does to them is not added to the errors
// of the details.
TEST_P(EncodeWith, DetailsComeBackWithinTheirStep) {
  constexpr int kLevels = 3;
  for (const test::Shape& shape : test::base_shapes()) {
    const Input input = random_input(shape, kLevels);
    encode::EncodeOptions options;
    options.finest_step = 1e-4;
    options.transform = GetParam();
    const encode::EncodedStream stream = encode::encode(input.base, input.decomposition, options);
    bitstream::StreamDecoder decoder;
    ASSERT_EQ(decoder.feed(stream.bytes), bitstream::DecodeStatus::done) << decoder.reason();
    EXPECT_EQ(decoder.coefficients().channels, stream.coefficients.channels);
    EXPECT_EQ(decoder.base_positions(), stream.base_positions);

    const surface::SubdivisionHierarchy hierarchy(input.base, kLevels, GetParam());
    const surface::Dequantisation dequantisation{decoder.header().finest_step, 4.0f};
    double mean_area = surface::mean_face_area(input.base, decoder.base_positions());
    for (int number = 0; number < kLevels; ++number, mean_area /= 4) {
      const surface::SubdivisionLevel& level = hierarchy.level(number);
      const surface::Positions predicted = surface::subdivide(
          level, surface::reconstruct(hierarchy, decoder.base_positions(), decoder.coefficients(),
                                      dequantisation, number));
      const std::size_t begin = bitstream::level_offset(hierarchy.base_edges().size(), number);
      std::size_t details = 0;
      for (std::size_t i = 0; i < level.edges.cell_to_edge.size(); ++i) {
        const std::uint32_t edge = level.edges.cell_to_edge[i];
        if (edge == bitstream::kNone) continue;
        ++details;
        const LocalDetail truth = local_detail(
            surface::edge_tangents(predicted.data(), level.vertex_count, level.edges.vertices[edge],
                                   level.edges.wings[edge]),
            mean_area, dequantisation, kLevels, number, input.decomposition.details[number][edge]);
        for (std::size_t c = 0; c < 3; ++c) {
          const double value = 0.5 * truth.units[c] * decoder.coefficients().channels[c][begin + i];
          // Half a step, or a whole one in the dead zone.
          ASSERT_LE(std::abs(value - truth.components[c]),
                    truth.units[c] * (value == 0.0 ? 1.0 : 0.5001))
              << shape.name;
        }
      }
      EXPECT_EQ(details, level.edge_count);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Transforms, EncodeWith, testing::ValuesIn(test::kTransforms),
                         [](const auto& transform) { return test::name_of(transform.param); });

TEST(Encode, BaseErrorStaysNearTheStep) {
  const Input input = random_input(test::base_shapes().front(), 3);
  encode::EncodeOptions options;
  options.finest_step = 1e-3;
  const encode::EncodedStream stream = encode::encode(input.base, input.decomposition, options);
  // An integer is up to 2.8 of the steps that the base's norm asks for long.
  const double most = 0.51 * 2.8 * options.finest_step / double{surface::basis_norm(3)};
  for (std::size_t v = 0; v < input.base.vertex_count; ++v) {
    for (int axis = 0; axis < 3; ++axis) {
      const double error = double{stream.base_positions[3 * v + axis]} -
                           input.decomposition.base_control_points[v][axis];
      EXPECT_LE(std::abs(error), most);
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
