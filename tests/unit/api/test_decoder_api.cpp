// The public C functions, used as an application uses them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>
#include <string>

#include "sample_streams.h"
#include "zerotree/zerotree.h"
#include "zerotree/zerotree.hpp"

extern "C" zt_status zt_test_status_of_nothing(void);

namespace zerotree::test {
namespace {

constexpr int kLevels = 3;

Sample sample_stream(const Shape& shape, bool embed_base) {
  return test::sample_stream(shape, {embed_base, kLevels});
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

TEST(DecoderApi, BoundStreamNeedsItsBase) {
  const Shape shape = base_shapes()[0];
  const Sample sample = sample_stream(shape, false);
  const std::vector<std::uint32_t> indices = flat_indices(sample.base);
  Decoder decoder(sample.stream.base_positions, indices, kLevels);
  ASSERT_EQ(decoder.feed(sample.stream.bytes), ZT_DONE) << decoder.reason();
  expect_complete(surface_of(decoder, kLevels));

  auto moved = sample.stream.base_positions;
  moved[0] += 0.25f;
  Decoder other(moved, indices, kLevels);
  EXPECT_EQ(other.feed(sample.stream.bytes), ZT_BROKEN);
  EXPECT_NE(std::string(other.reason()), "");
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
  EXPECT_EQ(zt_get_indices(decoder.get(), 0, nullptr, 4, 20), ZT_INVALID_ARGUMENT);
  EXPECT_EQ(zt_vertex_count(decoder.get(), kLevels + 1), 0u);
  EXPECT_EQ(zt_reconstruct(nullptr, 0, nullptr, 0, nullptr, 0, 0), ZT_INVALID_ARGUMENT);
  EXPECT_EQ(zt_feed(nullptr, nullptr, 0), ZT_BROKEN);
  EXPECT_EQ(zt_create_for_base(nullptr, 0, 3, nullptr, 1, 0, nullptr), nullptr);
  EXPECT_STREQ(zt_version(), "0.1.0");
  zt_free(nullptr);
}

TEST(DecoderApi, RefusesStreamsBeyondTheLimits) {
  const Sample sample = sample_stream(base_shapes()[0], true);
  zt_options limits = default_options();
  limits.max_vertices = 100;
  Decoder small(limits);
  EXPECT_EQ(small.feed(sample.stream.bytes), ZT_BROKEN);
  limits = default_options();
  limits.max_levels = kLevels - 1;
  Decoder shallow(limits);
  EXPECT_EQ(shallow.feed(sample.stream.bytes), ZT_BROKEN);
  EXPECT_NE(std::string(shallow.reason()), "");
}

// Streams with flipped bits: each is broken or a complete, finite surface.
TEST(DecoderApi, SurvivesFlippedBits) {
  const Sample sample = sample_stream(base_shapes()[2], true);
  zt_options limits = default_options();
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
