// Surfaces made again and again while bytes arrive equal those of a fresh decoder, bit for bit.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "sample_streams.h"

namespace zerotree::test {
namespace {

constexpr int kLevels = 3;

class IncrementalSurface : public testing::TestWithParam<std::tuple<Shape, bool>> {};

TEST_P(IncrementalSurface, EqualsAFreshDecode) {
  const auto& [shape, embedded] = GetParam();
  const Sample sample = sample_stream(shape, {embedded, kLevels, 1e-3});
  const std::span<const std::uint8_t> bytes = sample.stream.bytes;
  std::mt19937 random(11);
  Decoder growing = decoder_for(sample, embedded);
  std::size_t next = 0;
  while (next < bytes.size()) {
    // Often so few that only one level changes, or none.
    const std::size_t most = random() % 3 == 0 ? 200 : 6;
    const std::size_t size = std::min<std::size_t>(1 + random() % most, bytes.size() - next);
    growing.feed(bytes.subspan(next, size));
    next += size;
    if (growing.info().base_ready == 0 || random() % 4 == 0) continue;
    const int level = static_cast<int>(random() % (kLevels + 1));
    SurfaceSamples surface;
    ASSERT_EQ(growing.reconstruct(level, surface), ZT_OK);
    if (random() % 4 != 0) continue;
    Decoder fresh = decoder_for(sample, embedded);
    fresh.feed(bytes.first(next));
    SurfaceSamples expected;
    ASSERT_EQ(fresh.reconstruct(level, expected), ZT_OK);
    ASSERT_EQ(surface.positions, expected.positions) << "byte " << next << ", level " << level;
    ASSERT_EQ(surface.normals, expected.normals) << "byte " << next << ", level " << level;
  }
  EXPECT_EQ(growing.status(), ZT_DONE);
}

INSTANTIATE_TEST_SUITE_P(Shapes, IncrementalSurface,
                         testing::Combine(testing::ValuesIn(base_shapes()), testing::Bool()),
                         [](const auto& test) {
                           return std::get<0>(test.param).name +
                                  (std::get<1>(test.param) ? "_embedded" : "_bound");
                         });

}  // namespace
}  // namespace zerotree::test
