// The public C functions, used as an application uses them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <random>
#include <string>

#include "analysis/wavelet_decomposition.h"
#include "bitstream/base_traversal.h"
#include "encode/encode.h"
#include "shapes.h"
#include "surface/subdivision_hierarchy.h"
#include "zerotree/zerotree.h"
#include "zerotree/zerotree.hpp"

extern "C" zt_status zt_test_status_of_nothing(void);

namespace zerotree::test {
namespace {

constexpr int kLevels = 3;

struct Sample {
  bitstream::BaseTopology base;
  encode::EncodedStream stream;
};

/// A stream of random details over `shape`.
Sample sample_stream(const Shape& shape, bool embed_base) {
  const bitstream::BaseTopology plain{static_cast<std::uint32_t>(shape.mesh.positions.size()),
                                      shape.mesh.triangles, shape.crease_edges,
                                      shape.corner_vertices};
  const bitstream::BaseOrder order = bitstream::canonical_base_order(plain);
  Sample sample;
  sample.base = bitstream::reorder(plain, order);
  analysis::WaveletDecomposition decomposition;
  for (const std::uint32_t old : order.vertices)
    decomposition.base_control_points.push_back(shape.mesh.positions[old]);
  const surface::SubdivisionHierarchy hierarchy(sample.base, kLevels, {});
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (int level = 0; level < kLevels; ++level)
    for (auto& details = decomposition.details.emplace_back();
         details.size() < hierarchy.level(level).edge_count;)
      details.push_back(0.02 * std::pow(0.3, level) *
                        Eigen::Vector3d(uniform(random), uniform(random), uniform(random)));
  encode::EncodeOptions options;
  options.finest_step = 1e-3;
  options.embed_base = embed_base;
  sample.stream = encode::encode(sample.base, decomposition, options);
  return sample;
}

/// Every edge is used once in each direction, or once on a boundary; positions and normals are
/// finite, normals of length 1.
void expect_complete(const SurfaceSamples& surface) {
  ASSERT_FALSE(surface.indices.empty());
  std::vector<std::pair<std::uint32_t, std::uint32_t>> directed;
  for (std::size_t k = 0; k < surface.indices.size(); ++k) {
    ASSERT_LT(surface.indices[k], surface.positions.size() / 3);
    directed.emplace_back(surface.indices[k], surface.indices[k % 3 == 2 ? k - 2 : k + 1]);
  }
  std::sort(directed.begin(), directed.end());
  EXPECT_EQ(std::adjacent_find(directed.begin(), directed.end()), directed.end());
  for (const float x : surface.positions) ASSERT_TRUE(std::isfinite(x));
  for (std::size_t k = 0; k < surface.normals.size(); k += 3)
    ASSERT_NEAR(std::hypot(surface.normals[k], surface.normals[k + 1], surface.normals[k + 2]),
                1.0f, 1e-5f);
}

SurfaceSamples surface_of(Decoder& decoder, int level) {
  SurfaceSamples surface;
  EXPECT_EQ(decoder.reconstruct(level, surface), ZT_OK) << decoder.reason();
  return surface;
}

TEST(DecoderApi, IsUsableFromC) {
  EXPECT_EQ(zt_test_status_of_nothing(), ZT_MORE_BYTES_WANTED);
}

TEST(DecoderApi, DecodesEachShapeAtEachLevel) {
  for (const Shape& shape : base_shapes()) {
    const Sample sample = sample_stream(shape, true);
    Decoder decoder;
    ASSERT_EQ(decoder.feed(sample.stream.bytes), ZT_DONE) << decoder.reason();
    const zt_info info = decoder.info();
    EXPECT_EQ(info.levels, kLevels);
    EXPECT_EQ(info.detailed_levels, kLevels);
    EXPECT_EQ(info.base_vertex_count, sample.base.vertex_count);
    EXPECT_EQ(info.bytes_consumed, sample.stream.bytes.size());
    std::uint32_t triangles = info.base_triangle_count;
    for (int level = 0; level <= kLevels; ++level, triangles *= 4) {
      EXPECT_EQ(zt_triangle_count(decoder.get(), level), triangles);
      expect_complete(surface_of(decoder, level));
    }
  }
}

TEST(DecoderApi, PiecesMakeTheSameSurface) {
  const Sample sample = sample_stream(base_shapes()[0], true);
  Decoder whole, bytewise;
  whole.feed(sample.stream.bytes);
  for (const std::uint8_t byte : sample.stream.bytes) bytewise.feed({&byte, 1});
  EXPECT_EQ(bytewise.status(), ZT_DONE);
  EXPECT_EQ(surface_of(bytewise, kLevels).positions, surface_of(whole, kLevels).positions);
}

TEST(DecoderApi, EveryPrefixIsASurfaceOrWantsMore) {
  const Sample sample = sample_stream(base_shapes()[5], true);
  Decoder growing;
  for (std::size_t size = 0; size <= sample.stream.bytes.size(); ++size) {
    // An exactly sized copy, so that a sanitizer sees a read beyond the prefix.
    const std::vector<std::uint8_t> prefix(sample.stream.bytes.begin(),
                                           sample.stream.bytes.begin() + static_cast<long>(size));
    Decoder decoder;
    const zt_status status = decoder.feed(prefix);
    ASSERT_EQ(status, size < sample.stream.bytes.size() ? ZT_MORE_BYTES_WANTED : ZT_DONE)
        << size << ": " << decoder.reason();
    SurfaceSamples surface;
    if (decoder.info().base_ready) {
      ASSERT_EQ(decoder.reconstruct(2, surface), ZT_OK);
      expect_complete(surface);
    } else {
      ASSERT_EQ(zt_reconstruct(decoder.get(), 0, nullptr, 0, nullptr, 0, 0), ZT_NOT_READY);
    }
  }
}

TEST(DecoderApi, BoundStreamStartsFromTheBaseAlone) {
  const Shape shape = base_shapes()[0];
  const Sample sample = sample_stream(shape, false);
  std::vector<std::uint32_t> indices;
  for (const auto& triangle : sample.base.triangles)
    indices.insert(indices.end(), triangle.begin(), triangle.end());
  Decoder decoder(sample.stream.base_positions, indices);
  ASSERT_EQ(decoder.feed(sample.stream.bytes), ZT_DONE) << decoder.reason();
  expect_complete(surface_of(decoder, kLevels));

  auto moved = sample.stream.base_positions;
  moved[0] += 0.25f;
  Decoder other(moved, indices);
  EXPECT_EQ(other.feed(sample.stream.bytes), ZT_BROKEN);
  EXPECT_NE(std::string(other.reason()), "");
  indices[0] = 1000000;
  Decoder hostile(sample.stream.base_positions, indices);
  EXPECT_EQ(hostile.feed(sample.stream.bytes), ZT_BROKEN);
}

TEST(DecoderApi, BoundsHoldTheSurface) {
  const Sample sample = sample_stream(base_shapes()[3], true);
  Decoder decoder;
  const std::size_t half = sample.stream.bytes.size() / 2;
  decoder.feed(std::span(sample.stream.bytes).first(half));
  float low[3], high[3];
  ASSERT_EQ(zt_get_bounds(decoder.get(), low, high), ZT_OK);
  const SurfaceSamples surface = surface_of(decoder, kLevels);
  for (std::size_t k = 0; k < surface.positions.size(); ++k) {
    EXPECT_GE(surface.positions[k], low[k % 3] - 1e-5f);
    EXPECT_LE(surface.positions[k], high[k % 3] + 1e-5f);
  }
}

TEST(DecoderApi, WritesIntoStridedBuffers) {
  const Sample sample = sample_stream(base_shapes()[1], true);
  Decoder decoder;
  decoder.feed(sample.stream.bytes);
  const SurfaceSamples packed = surface_of(decoder, 1);
  const std::uint32_t count = zt_vertex_count(decoder.get(), 1);
  // Interleaved and, on purpose, not aligned.
  constexpr std::size_t kStride = 29;
  std::vector<unsigned char> bytes(kStride * (count - 1) + 1 + 24, 0xab);
  ASSERT_EQ(zt_reconstruct(decoder.get(), 1, &bytes[1], kStride, &bytes[13], kStride, count),
            ZT_OK);
  for (std::size_t v = 0; v < count; ++v) {
    EXPECT_EQ(std::memcmp(&bytes[1 + v * kStride], &packed.positions[3 * v], 12), 0);
    EXPECT_EQ(std::memcmp(&bytes[13 + v * kStride], &packed.normals[3 * v], 12), 0);
  }
  EXPECT_EQ(bytes[0], 0xab);
  EXPECT_EQ(bytes[25], 0xab);
}

TEST(DecoderApi, AnswersWrongArguments) {
  const Sample sample = sample_stream(base_shapes()[0], true);
  Decoder decoder;
  decoder.feed(sample.stream.bytes);
  std::vector<float> positions(12);
  const auto reconstruct = [&](int level, std::uint32_t capacity) {
    return zt_reconstruct(decoder.get(), level, positions.data(), 0, nullptr, 0, capacity);
  };
  EXPECT_EQ(reconstruct(-1, 4), ZT_INVALID_ARGUMENT);
  EXPECT_EQ(reconstruct(kLevels + 1, 1u << 30), ZT_INVALID_ARGUMENT);
  EXPECT_EQ(reconstruct(0, 4), ZT_INVALID_ARGUMENT);
  EXPECT_EQ(zt_get_indices(decoder.get(), 0, nullptr, 20), ZT_INVALID_ARGUMENT);
  EXPECT_EQ(zt_vertex_count(decoder.get(), kLevels + 1), 0u);
  EXPECT_EQ(zt_reconstruct(nullptr, 0, nullptr, 0, nullptr, 0, 0), ZT_INVALID_ARGUMENT);
  EXPECT_EQ(zt_feed(nullptr, nullptr, 0), ZT_BROKEN);
  EXPECT_EQ(zt_create_for_base(nullptr, 0, 3, nullptr, 1, nullptr), nullptr);
  EXPECT_STREQ(zt_version(), "0.1.0");
  zt_free(nullptr);
}

TEST(DecoderApi, RefusesStreamsBeyondTheLimits) {
  const Sample sample = sample_stream(base_shapes()[0], true);
  zt_limits limits = zt_default_limits();
  limits.max_vertices = 100;
  Decoder small(limits);
  EXPECT_EQ(small.feed(sample.stream.bytes), ZT_BROKEN);
  limits = zt_default_limits();
  limits.max_levels = kLevels - 1;
  Decoder shallow(limits);
  EXPECT_EQ(shallow.feed(sample.stream.bytes), ZT_BROKEN);
  EXPECT_NE(std::string(shallow.reason()), "");
}

// Streams with flipped bits: each is broken or a complete, finite surface.
TEST(DecoderApi, SurvivesFlippedBits) {
  const Sample sample = sample_stream(base_shapes()[2], true);
  zt_limits limits = zt_default_limits();
  limits.max_vertices = 100000;
  limits.max_memory = 64u << 20;
  std::mt19937 random(9);
  int surfaces = 0;
  for (int round = 0; round < 300; ++round) {
    auto bytes = sample.stream.bytes;
    const std::size_t span = round % 2 ? std::min<std::size_t>(bytes.size(), 60) : bytes.size();
    for (int flip = 0; flip <= round % 3; ++flip)
      bytes[random() % span] ^= static_cast<std::uint8_t>(1u << random() % 8);
    Decoder decoder(limits);
    const zt_status status = decoder.feed(bytes);
    SurfaceSamples surface;
    if (!decoder.info().base_ready || decoder.info().levels < 1) continue;
    const zt_result result = decoder.reconstruct(1, surface);
    if (status == ZT_BROKEN) {
      EXPECT_EQ(result, ZT_BROKEN_STREAM);
    } else if (result == ZT_OK) {
      ++surfaces;
      ASSERT_FALSE(surface.indices.empty());
      for (const float x : surface.normals) ASSERT_TRUE(std::isfinite(x));
    }
  }
  EXPECT_GT(surfaces, 50);
}

}  // namespace
}  // namespace zerotree::test
