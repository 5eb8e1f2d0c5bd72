// Boxes, errors of levels and errors of prefixes, against the surfaces themselves.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "analysis/wavelet_decomposition.h"
#include "bitstream/base_traversal.h"
#include "sample_streams.h"

namespace zerotree::test {
namespace {

struct Box {
  std::array<float, 3> low, high;
};

Box bounds_of(Decoder& decoder) {
  Box box;
  EXPECT_EQ(zt_get_bounds(decoder.get(), box.low.data(), box.high.data()), ZT_OK);
  return box;
}

SurfaceSamples surface_of(Decoder& decoder, int level) {
  SurfaceSamples surface;
  EXPECT_EQ(decoder.reconstruct(level, surface), ZT_OK) << decoder.reason();
  return surface;
}

Box true_box(const SurfaceSamples& surface) {
  Box box;
  box.low.fill(std::numeric_limits<float>::max());
  box.high.fill(std::numeric_limits<float>::lowest());
  for (std::size_t i = 0; i < surface.positions.size(); ++i) {
    box.low[i % 3] = std::min(box.low[i % 3], surface.positions[i]);
    box.high[i % 3] = std::max(box.high[i % 3], surface.positions[i]);
  }
  return box;
}

/// How far the triangles of `level` are from those of the finest level at most, where each point
/// of a triangle is compared with the one that subdivision makes of it.
double distance_of_level(Decoder& decoder, int level, int levels) {
  const SurfaceSamples finest = surface_of(decoder, levels);
  const SurfaceSamples coarse = surface_of(decoder, level);
  std::vector<float> flat(finest.positions.size());
  std::copy(coarse.positions.begin(), coarse.positions.end(), flat.begin());
  std::vector<std::uint32_t> parents = coarse.indices;
  for (int finer = level + 1; finer <= levels; ++finer) {
    const std::vector<std::uint32_t> children = surface_of(decoder, finer).indices;
    // The child in the middle has the midpoints of sides 1, 2 and 0.
    for (std::size_t t = 0; 3 * t < parents.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t side = (k + 1) % 3;
        const std::uint32_t odd = children[12 * t + 9 + k];
        const std::uint32_t tail = parents[3 * t + side], head = parents[3 * t + (side + 1) % 3];
        for (std::size_t axis = 0; axis < 3; ++axis)
          flat[3 * odd + axis] = (flat[3 * tail + axis] + flat[3 * head + axis]) / 2;
      }
    parents = children;
  }
  double farthest = 0.0;
  for (std::size_t i = 0; i < flat.size(); i += 3)
    farthest = std::max<double>(
        farthest, std::hypot(flat[i] - finest.positions[i], flat[i + 1] - finest.positions[i + 1],
                             flat[i + 2] - finest.positions[i + 2]));
  return farthest;
}

std::vector<float> level_errors(Decoder& decoder, int levels) {
  std::vector<float> errors;
  for (int level = 0; level <= levels; ++level) {
    errors.push_back(-1.0f);
    EXPECT_EQ(zt_get_level_error(decoder.get(), level, &errors.back()), ZT_OK);
  }
  return errors;
}

class SurfaceMeasures : public testing::TestWithParam<Shape> {
 protected:
  static constexpr int kLevels = 3;
  Sample sample() const { return sample_stream(GetParam(), {false, kLevels, 1e-3}); }
  /// Calls part(decoder) after each of some prefixes, for each sampling.
  template <class Part>
  void for_prefixes(const Sample& sample, const Part& part) {
    for (const zt_sampling sampling : {ZT_SAMPLE_LIMIT, ZT_SAMPLE_BALANCED}) {
      SCOPED_TRACE(sampling);
      for_prefixes_of(sample, sampling, part);
    }
  }
  template <class Part>
  void for_prefixes_of(const Sample& sample, zt_sampling sampling, const Part& part) {
    zt_options options = default_options();
    options.sampling = sampling;
    Decoder decoder(sample.stream.base_positions, flat_indices(sample.base), sample.levels,
                    options);
    const std::span<const std::uint8_t> bytes = sample.stream.bytes;
    constexpr std::size_t kParts = 12;
    for (std::size_t k = 0; k <= kParts; ++k) {
      SCOPED_TRACE(k);
      part(decoder);
      const std::size_t begin = bytes.size() * k / kParts, end = bytes.size() * (k + 1) / kParts;
      if (k < kParts) decoder.feed(bytes.subspan(begin, end - begin));
    }
    EXPECT_EQ(decoder.status(), ZT_DONE);
  }
};

TEST_P(SurfaceMeasures, BoxesHoldTheSurfaceOfEachLevelAndPrefix) {
  for_prefixes(sample(), [](Decoder& decoder) {
    const Box box = bounds_of(decoder);
    for (int level = 0; level <= kLevels; ++level) {
      const Box inside = true_box(surface_of(decoder, level));
      for (std::size_t axis = 0; axis < 3; ++axis) {
        EXPECT_LE(box.low[axis], inside.low[axis] + 1e-5f) << "level " << level;
        EXPECT_GE(box.high[axis], inside.high[axis] - 1e-5f) << "level " << level;
      }
    }
  });
}

TEST_P(SurfaceMeasures, ErrorsFallAndBoundTheDistanceOfEachLevel) {
  for_prefixes(sample(), [](Decoder& decoder) {
    const std::vector<float> errors = level_errors(decoder, kLevels);
    EXPECT_TRUE(std::is_sorted(errors.rbegin(), errors.rend()));
    EXPECT_EQ(errors.back(), 0.0f);
    for (int level = 0; level < kLevels; ++level) {
      const double distance = distance_of_level(decoder, level, kLevels);
      EXPECT_LE(distance, errors[static_cast<std::size_t>(level)] + 1e-5) << "level " << level;
      EXPECT_GE(3 * distance, errors[static_cast<std::size_t>(level)] - 1e-5) << "level " << level;
    }
  });
}

TEST_P(SurfaceMeasures, ChooseTheCoarsestLevelOfAnError) {
  for_prefixes(sample(), [](Decoder& decoder) {
    const std::vector<float> errors = level_errors(decoder, kLevels);
    const auto chosen = [&](float most) {
      int level = -1;
      EXPECT_EQ(zt_choose_level(decoder.get(), most, &level), ZT_OK);
      return level;
    };
    for (int level = 0; level <= kLevels; ++level) {
      const float error = errors[static_cast<std::size_t>(level)];
      const auto first = std::find(errors.begin(), errors.end(), error);
      EXPECT_EQ(chosen(error), first - errors.begin());
      if (level > 0 && first - errors.begin() == level) {
        EXPECT_EQ(chosen(std::nextafter(errors[static_cast<std::size_t>(level) - 1], 0.0f)), level);
      }
    }
    EXPECT_EQ(chosen(1e30f), 0);
    EXPECT_EQ(chosen(-1.0f), kLevels);
  });
}

INSTANTIATE_TEST_SUITE_P(Shapes, SurfaceMeasures, testing::ValuesIn(base_shapes()),
                         [](const auto& shape) { return shape.param.name; });

// Details as those of a scan: each level's are a quarter of the one before.
TEST(Bounds, AreCloseToTheSurface) {
  const Sample sample =
      sample_stream({"bumpy", add_bumps(sphere(1), 0.05, 1.5), {}, {}}, {true, 5, 1e-4});
  Decoder decoder;
  ASSERT_EQ(decoder.feed(sample.stream.bytes), ZT_DONE);
  const Box box = bounds_of(decoder), inside = true_box(surface_of(decoder, 5));
  for (std::size_t axis = 0; axis < 3; ++axis)
    EXPECT_LE(box.high[axis] - box.low[axis], 1.5f * (inside.high[axis] - inside.low[axis]));
}

// Beyond level 5 errors are foreseen, not measured.
TEST(LevelErrors, OfDeepStreamsFallToZero) {
  const Sample sample = sample_stream(base_shapes()[0], {true, 7, 1e-3});
  Decoder decoder;
  ASSERT_EQ(decoder.feed(sample.stream.bytes), ZT_DONE);
  const std::vector<float> errors = level_errors(decoder, 7);
  for (std::size_t level = 0; level < 7; ++level) EXPECT_GT(errors[level], errors[level + 1]);
  EXPECT_EQ(errors.back(), 0.0f);
}

// A transform whose points come from mesh-wide stencils is measured as well.
TEST(LevelErrors, AndBoundsOfTheMirrorTransform) {
  const Shape shape = base_shapes()[0];
  const bitstream::BaseTopology plain{
      static_cast<std::uint32_t>(shape.mesh.positions.size()), shape.mesh.triangles, {}, {}};
  const bitstream::BaseOrder order = bitstream::canonical_base_order(plain);
  const bitstream::BaseTopology base = reorder(plain, order);
  const surface::SubdivisionHierarchy hierarchy(base, 2,
                                                surface::WaveletTransform::loop_quadrature_mirror);
  analysis::WaveletDecomposition decomposition;
  for (const std::uint32_t old : order.vertices)
    decomposition.base_control_points.push_back(shape.mesh.positions[old]);
  for (int level = 0; level < 2; ++level)
    decomposition.details.emplace_back(hierarchy.level(level).edge_count,
                                       Eigen::Vector3d(0.02, 0.01, -0.01));
  encode::EncodeOptions options;
  options.embed_base = true;
  options.finest_step = 1e-3;
  Decoder decoder;
  ASSERT_EQ(decoder.feed(encode::encode(hierarchy, decomposition, options).bytes), ZT_DONE);
  const std::vector<float> errors = level_errors(decoder, 2);
  for (int level = 0; level < 2; ++level)
    EXPECT_LE(distance_of_level(decoder, level, 2), errors[static_cast<std::size_t>(level)] + 1e-5);
  const Box box = bounds_of(decoder), inside = true_box(surface_of(decoder, 2));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    EXPECT_LE(box.low[axis], inside.low[axis]);
    EXPECT_GE(box.high[axis], inside.high[axis]);
  }
}

TEST(PrefixErrors, TellWhichBytesAreEnough) {
  const Sample sample = sample_stream(base_shapes()[0], {true, 3, 1e-3});
  const std::size_t size = sample.stream.bytes.size();
  ASSERT_GT(size, 300u);
  Decoder decoder;
  EXPECT_EQ(zt_bytes_for_error(decoder.get(), 1.0f), 0u);
  EXPECT_LT(decoder.info().error, 0.0f);
  const std::array<zt_prefix_error, 3> rows = {{{100, 0.5f}, {200, 0.25f}, {300, 0.125f}}};
  EXPECT_EQ(zt_set_prefix_errors(decoder.get(), nullptr, 1), ZT_INVALID_ARGUMENT);
  ASSERT_EQ(zt_set_prefix_errors(decoder.get(), rows.data(), 3), ZT_OK);
  EXPECT_EQ(zt_bytes_for_error(decoder.get(), 1.0f), 100u);
  EXPECT_EQ(zt_bytes_for_error(decoder.get(), 0.25f), 200u);
  EXPECT_EQ(zt_bytes_for_error(decoder.get(), 0.2f), 300u);
  EXPECT_EQ(zt_bytes_for_error(decoder.get(), 0.01f), 300u);
  const std::span<const std::uint8_t> bytes = sample.stream.bytes;
  decoder.feed(bytes.first(99));
  EXPECT_LT(decoder.info().error, 0.0f);
  decoder.feed(bytes.subspan(99, 1));
  EXPECT_EQ(decoder.info().error, 0.5f);
  decoder.feed(bytes.subspan(100));
  EXPECT_EQ(decoder.info().error, 0.125f);
  ASSERT_EQ(zt_set_prefix_errors(decoder.get(), nullptr, 0), ZT_OK);
  EXPECT_LT(decoder.info().error, 0.0f);
}

}  // namespace
}  // namespace zerotree::test
