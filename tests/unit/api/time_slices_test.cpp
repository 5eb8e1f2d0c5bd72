// Surfaces made in slices of time, and what happens in between.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <random>

#include "sample_streams.h"

namespace zerotree::test {
namespace {

constexpr int kLevels = 3;

Sample sample_of(const Shape& shape) {
  return sample_stream(shape, {true, kLevels, 1e-3});
}

/// Positions and normals, interleaved.
struct Buffer {
  explicit Buffer(std::uint32_t count, float filling = -99.0f)
      : vertices(count), floats(6 * std::size_t{count}, filling) {}
  zt_result make(zt_decoder* decoder, int level) {
    return zt_reconstruct(decoder, level, floats.data(), 24, floats.data() + 3, 24, vertices);
  }
  zt_result make_some(zt_decoder* decoder, int level, std::uint32_t budget_us) {
    return zt_reconstruct_for(decoder, level, floats.data(), 24, floats.data() + 3, 24, vertices,
                              budget_us);
  }
  std::uint32_t vertices;
  std::vector<float> floats;
};

/// That of a decoder that got the whole prefix at once.
std::vector<float> expected_surface(const Sample& sample, std::size_t prefix, int level) {
  Decoder decoder;
  decoder.feed(std::span(sample.stream.bytes).first(prefix));
  Buffer buffer(zt_vertex_count(decoder.get(), level));
  EXPECT_EQ(buffer.make(decoder.get(), level), ZT_OK);
  return buffer.floats;
}

int finish(Buffer& buffer, Decoder& decoder, int level, std::uint32_t budget_us) {
  constexpr int kMostSlices = 100000;
  for (int slices = 1; slices < kMostSlices; ++slices) {
    const zt_result result = buffer.make_some(decoder.get(), level, budget_us);
    if (result == ZT_OK) return slices;
    if (result != ZT_UNFINISHED) break;
  }
  ADD_FAILURE() << "does not end";
  return 0;
}

class TimeSlices : public testing::TestWithParam<Shape> {};

TEST_P(TimeSlices, MakeTheSameSurface) {
  const Sample sample = sample_of(GetParam());
  const std::size_t size = sample.stream.bytes.size();
  for (const std::uint32_t budget_us : {0u, 1u, 1000000u}) {
    Decoder decoder;
    decoder.feed(sample.stream.bytes);
    for (const int level : {1, kLevels, 0, kLevels}) {
      Buffer buffer(zt_vertex_count(decoder.get(), level));
      const int slices = finish(buffer, decoder, level, budget_us);
      EXPECT_TRUE(slices > 1 || budget_us > 0 || level == 0);
      ASSERT_EQ(buffer.floats, expected_surface(sample, size, level));
    }
  }
}

TEST_P(TimeSlices, WithBytesInBetweenMakeTheSurfaceOfAllBytes) {
  const Sample sample = sample_of(GetParam());
  const std::span<const std::uint8_t> bytes = sample.stream.bytes;
  std::mt19937 random(3);
  for (int round = 0; round < 5; ++round) {
    Decoder decoder;
    std::size_t next = sample.stream.pass_ends.front().bytes + 4;
    decoder.feed(bytes.first(next));
    Buffer buffer(zt_vertex_count(decoder.get(), kLevels));
    zt_result result = ZT_UNFINISHED;
    while (next < bytes.size() || result != ZT_OK) {
      result = buffer.make_some(decoder.get(), kLevels, 0);
      ASSERT_TRUE(result == ZT_OK || result == ZT_UNFINISHED);
      if (result == ZT_OK) {
        ASSERT_EQ(buffer.floats, expected_surface(sample, next, kLevels));
      }
      if (random() % 4 != 0 && result != ZT_OK) continue;
      const std::size_t size = std::min<std::size_t>(random() % 100, bytes.size() - next);
      decoder.feed(bytes.subspan(next, size));
      next += size;
      if (size > 0) result = ZT_UNFINISHED;
    }
  }
}

// Half a request for one level, then another level, deeper than what there was; then back.
TEST_P(TimeSlices, OfAnotherLevelOrBufferAreRight) {
  const Sample sample = sample_of(GetParam());
  const std::size_t size = sample.stream.bytes.size();
  for (int abandoned = 1; abandoned < 60; ++abandoned) {
    SCOPED_TRACE(abandoned);
    Decoder decoder;
    decoder.feed(sample.stream.bytes);
    Buffer coarse(zt_vertex_count(decoder.get(), 2));
    for (int slice = 0; slice < abandoned; ++slice) coarse.make_some(decoder.get(), 2, 0);
    Buffer fine(zt_vertex_count(decoder.get(), kLevels));
    for (int slice = 0; slice < abandoned; ++slice) fine.make_some(decoder.get(), kLevels, 0);
    Buffer other(zt_vertex_count(decoder.get(), kLevels), 7.0f);
    finish(other, decoder, kLevels, 0);
    ASSERT_EQ(other.floats, expected_surface(sample, size, kLevels));
    finish(coarse, decoder, 2, 0);
    ASSERT_EQ(coarse.floats, expected_surface(sample, size, 2));
  }
}

// A request without a deadline writes all, even where one with a deadline had begun the same.
TEST_P(TimeSlices, AreNotGoneOnWithByAWholeRequest) {
  const Sample sample = sample_of(GetParam());
  Decoder decoder;
  decoder.feed(sample.stream.bytes);
  const std::vector<float> expected = expected_surface(sample, sample.stream.bytes.size(), kLevels);
  for (int slices = 1; slices < 40; ++slices) {
    Buffer buffer(zt_vertex_count(decoder.get(), kLevels));
    for (int slice = 0; slice < slices; ++slice) buffer.make_some(decoder.get(), kLevels, 0);
    std::fill(buffer.floats.begin(), buffer.floats.end(), -99.0f);
    ASSERT_EQ(buffer.make(decoder.get(), kLevels), ZT_OK);
    ASSERT_EQ(buffer.floats, expected);
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, TimeSlices,
                         testing::Values(base_shapes()[0], base_shapes()[1], base_shapes()[2],
                                         base_shapes()[4]),
                         [](const auto& shape) { return shape.param.name; });

}  // namespace
}  // namespace zerotree::test
