// A stream decodes with the transform it names, to the surface that was encoded.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "bitstream/base_traversal.h"
#include "encode/encode.h"
#include "encode/stream_encoder.h"
#include "progressive/progressive_surface.h"
#include "random_content.h"
#include "shapes.h"
#include "surface/detail_weights.h"
#include "surface/edge_frames.h"
#include "surface/surface_synthesis.h"
#include "transforms.h"

namespace zerotree {
namespace {

using surface::Positions;
using surface::SubdivisionHierarchy;
using surface::SubdivisionLevel;

constexpr int kLevels = 3;
constexpr double kStep = 1e-3;

struct Encoded {
  analysis::WaveletDecomposition decomposition;
  encode::EncodedStream stream;
};

// Details are large beside the step: frames from elsewhere than the decoded surface would show.
Encoded encoded(const test::Shape& shape, surface::WaveletTransform transform) {
  const bitstream::BaseTopology plain{static_cast<std::uint32_t>(shape.mesh.positions.size()),
                                      shape.mesh.triangles, shape.crease_edges,
                                      shape.corner_vertices};
  const bitstream::BaseOrder order = bitstream::canonical_base_order(plain);
  const SubdivisionHierarchy hierarchy(bitstream::reorder(plain, order), kLevels, transform);
  Encoded result;
  for (const std::uint32_t old : order.vertices)
    result.decomposition.base_control_points.push_back(shape.mesh.positions[old]);
  std::mt19937 random(9);
  std::uniform_real_distribution<double> uniform(-0.2, 0.2);
  for (int level = 0; level < kLevels; ++level)
    for (auto& details = result.decomposition.details.emplace_back();
         details.size() < hierarchy.level(level).edge_count;)
      details.push_back(std::ldexp(1.0, -level) *
                        Eigen::Vector3d(uniform(random), uniform(random), uniform(random)));
  encode::EncodeOptions options;
  options.finest_step = kStep;
  result.stream = encode::encode(hierarchy, result.decomposition, options);
  return result;
}

surface::Moves single_precision(const std::vector<Eigen::Vector3d>& vectors) {
  surface::Moves result;
  for (const Eigen::Vector3d& v : vectors)
    for (int axis = 0; axis < 3; ++axis) result.push_back(static_cast<float>(v[axis]));
  return result;
}

// By how much each detail of a level may differ: half a step per component, a whole one where
// nothing is sent. `predicted` is the decoded surface without them.
std::vector<double> detail_errors(const surface::ProgressiveSurface& decoded,
                                  const SubdivisionLevel& level, int number,
                                  const Positions& predicted) {
  const bitstream::CoefficientSet set = decoded.decoder().coefficients();
  const surface::Dequantisation steps{decoded.decoder().header().finest_step, 4.0f};
  const double mean_area = std::ldexp(
      surface::mean_face_area(decoded.base(), decoded.decoder().base_positions()), -2 * number);
  std::vector<double> errors(level.edge_count);
  for (std::size_t cell = 0; cell < level.edges.cell_to_edge.size(); ++cell) {
    const std::uint32_t edge = level.edges.cell_to_edge[cell];
    if (edge == bitstream::kNone) continue;
    const double area = surface::edge_tangents(predicted.data(), level.vertex_count,
                                               level.edges.vertices[edge], level.edges.wings[edge])
                            .triangle_area();
    double squared = 0.0;
    for (std::size_t c = 0; c < bitstream::kChannelCount; ++c) {
      const std::size_t place = bitstream::level_offset(set.base_edge_count, number) + cell;
      const double unit =
          double{detail_unit(steps, kLevels, number, static_cast<bitstream::Channel>(c))};
      squared += unit * unit * (set.channels[c][place] == 0 ? 1.0 : 0.25);
    }
    errors[edge] = std::sqrt(squared) / double{surface::area_weight(area, mean_area)};
  }
  return errors;
}

// How far details of the lengths given can move a vertex.
double largest_move(const SubdivisionLevel& level, const std::vector<double>& lengths) {
  std::vector<double> moved(level.vertex_count + level.edge_count, 0.0);
  surface::Moves moves(3 * std::size_t{level.edge_count}, 0.0f);
  for (std::size_t edge = 0; edge < level.edge_count; ++edge) {
    Positions fine(3 * moved.size(), 0.0f);
    moves[3 * edge] = 1.0f;
    surface::add_details(level, moves, fine);
    moves[3 * edge] = 0.0f;
    for (std::size_t v = 0; v < moved.size(); ++v)
      moved[v] += lengths[edge] * std::abs(static_cast<double>(fine[3 * v]));
  }
  return *std::max_element(moved.begin(), moved.end());
}

double largest_difference(const Positions& a, const Positions& b) {
  double largest = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k)
    largest = std::max(largest, std::abs(double{a[k]} - double{b[k]}));
  return largest;
}

surface::Dequantisation steps_of(const surface::ProgressiveSurface& decoded) {
  const bitstream::StreamHeader& header = decoded.decoder().header();
  return {header.finest_step, std::ldexp(1.0f, header.tangent_ratio_log2)};
}

/// Limit positions of control points, and of what was decoded.
Positions limit_of(const SubdivisionLevel& level, const Positions& points) {
  Positions limit(points.size());
  surface::limit_surface(level, points, {limit.data()}, {});
  return limit;
}
Positions limit_of(surface::ProgressiveSurface& decoded, int level) {
  Positions limit(3 * decoded.counts(level).vertices);
  EXPECT_EQ(decoded.write_limits(level, {{limit.data()}, {}}), surface::SurfaceOutcome::done);
  return limit;
}

class DecodedSurface : public testing::TestWithParam<surface::WaveletTransform> {};

// P passes the error of coarser levels on without making it larger, so those of the details add up
// and nothing else does: they do not turn each other's frames.
TEST_P(DecodedSurface, IsTheEncodedOneWithinTheSteps) {
  for (const test::Shape& shape : test::base_shapes()) {
    const Encoded sample = encoded(shape, GetParam());
    surface::ProgressiveSurface decoded;
    ASSERT_EQ(decoded.feed(sample.stream.bytes), bitstream::DecodeStatus::done);
    EXPECT_EQ(decoded.decoder().header().transform, static_cast<std::uint32_t>(GetParam()));
    const SubdivisionHierarchy hierarchy(decoded.base(), kLevels, GetParam());
    const surface::Dequantisation steps = steps_of(decoded);
    Positions expected = sample.stream.base_positions, points = expected;
    double bound = 1e-5;
    for (int number = 0; number < kLevels; ++number) {
      const SubdivisionLevel& level = hierarchy.level(number);
      expected = surface::subdivide(level, expected);
      surface::add_details(level, single_precision(sample.decomposition.details[number]), expected);
      bound += largest_move(
          level, detail_errors(decoded, level, number, surface::subdivide(level, points)));
      points = surface::reconstruct(hierarchy, sample.stream.base_positions,
                                    decoded.decoder().coefficients(), steps, number + 1);
      // Limit positions are weighted means of control points.
      const Positions limit = limit_of(decoded, number + 1);
      EXPECT_LT(largest_difference(limit, limit_of(hierarchy.level(number + 1), expected)), bound)
          << shape.name << " at level " << number + 1;
    }
  }
}

// Between limit and control points, along creases and at corners too.
TEST_P(DecodedSurface, CanBeSampledOutsideTheLimit) {
  constexpr float kOutward = 0.25f;
  for (const test::Shape& shape : test::base_shapes()) {
    const Encoded sample = encoded(shape, GetParam());
    surface::ProgressiveSurface decoded;
    ASSERT_EQ(decoded.feed(sample.stream.bytes), bitstream::DecodeStatus::done);
    const SubdivisionHierarchy hierarchy(decoded.base(), kLevels, GetParam());
    const Positions points =
        surface::reconstruct(hierarchy, sample.stream.base_positions,
                             decoded.decoder().coefficients(), steps_of(decoded), kLevels);
    Positions expected = limit_of(hierarchy.level(kLevels), points), found(expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i)
      expected[i] += kOutward * (points[i] - expected[i]);
    ASSERT_EQ(decoded.write_limits(kLevels, {{found.data()}, {}, kOutward}),
              surface::SurfaceOutcome::done);
    EXPECT_LT(largest_difference(found, expected), 1e-5) << shape.name;
  }
}

TEST(DecodedSurfaceOfAnUnknownTransform, IsRefused) {
  encode::StreamContent content =
      test::empty_content(test::canonical_base(test::base_shapes()[0]), 2, true, 1);
  content.header.transform = 2;
  surface::ProgressiveSurface decoded;
  EXPECT_EQ(decoded.feed(encode::encode_stream(content).bytes), bitstream::DecodeStatus::broken);
  EXPECT_FALSE(decoded.is_ready());
  EXPECT_NE(decoded.reason().find("transform 2"), std::string::npos) << decoded.reason();
}

// An external base is shown before the header comes, with any transform.
TEST_P(DecodedSurface, OverAnExternalBaseChangesToTheTransformNamed) {
  const bitstream::BaseTopology base = test::canonical_base(test::base_shapes()[0]);
  encode::StreamContent content = test::empty_content(base, 2, false, 1);
  content.header.transform = static_cast<std::uint32_t>(GetParam());
  test::add_random_details(content, 0.5, 3, 4);
  const std::vector<std::uint8_t> bytes = encode::encode_stream(content).bytes;
  surface::ProgressiveSurface decoded({base, test::external_positions(base), 2});
  const Positions smooth = limit_of(decoded, 2);
  ASSERT_EQ(decoded.feed(bytes), bitstream::DecodeStatus::done) << decoded.reason();
  const SubdivisionHierarchy hierarchy(base, 2, GetParam());
  const Positions expected = limit_of(
      hierarchy.level(2), surface::reconstruct(hierarchy, test::external_positions(base),
                                               content.coefficients, steps_of(decoded), 2));
  EXPECT_LT(largest_difference(limit_of(decoded, 2), expected), 1e-5);
  EXPECT_GT(largest_difference(smooth, expected), 1e-3);
}

INSTANTIATE_TEST_SUITE_P(Transforms, DecodedSurface, testing::ValuesIn(test::kTransforms),
                         [](const auto& transform) { return test::name_of(transform.param); });

}  // namespace
}  // namespace zerotree
