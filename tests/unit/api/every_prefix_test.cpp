// Every prefix length of small streams, through the public C functions.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <memory>

#include "bitstream/coded_passes.h"
#include "sample_streams.h"
#include "surface/surface_synthesis.h"
#include "zerotree/zerotree.h"

namespace zerotree::test {
namespace {

constexpr int kLevels = 2;

/// The first `size` bytes in memory of exactly that size: a sanitizer sees a read beyond them.
struct ExactBytes {
  ExactBytes(const std::vector<std::uint8_t>& bytes, std::size_t prefix)
      : data(new std::uint8_t[prefix]), size(prefix) {
    std::copy_n(bytes.begin(), prefix, data.get());
  }
  std::unique_ptr<std::uint8_t[]> data;
  std::size_t size;
};

SurfaceSamples surface_of(Decoder& decoder, int level) {
  SurfaceSamples surface;
  EXPECT_EQ(decoder.reconstruct(level, surface), ZT_OK) << decoder.reason();
  return surface;
}

/// What each level must have, whatever the prefix.
struct Expected {
  std::uint64_t vertices, edges, triangles, boundary;
};

std::vector<Expected> expected_levels(const bitstream::BaseTopology& base) {
  SurfaceSamples control_mesh;
  control_mesh.positions.resize(std::size_t{3} * base.vertex_count);
  control_mesh.indices = flat_indices(base);
  const std::uint64_t boundary = expect_complete(control_mesh);
  const std::uint64_t triangles = base.triangles.size();
  std::vector<Expected> levels = {
      {base.vertex_count, (3 * triangles + boundary) / 2, triangles, boundary}};
  for (int level = 0; level < kLevels; ++level) {
    const Expected& e = levels.back();
    levels.push_back(
        {e.vertices + e.edges, 2 * e.edges + 3 * e.triangles, 4 * e.triangles, 2 * e.boundary});
  }
  return levels;
}

void expect_surface(Decoder& decoder, const std::vector<Expected>& expected) {
  ASSERT_EQ(decoder.info().levels, kLevels);
  for (int level = 0; level <= kLevels; ++level) {
    const Expected& counts = expected[static_cast<std::size_t>(level)];
    ASSERT_EQ(zt_vertex_count(decoder.get(), level), counts.vertices);
    ASSERT_EQ(zt_triangle_count(decoder.get(), level), counts.triangles);
    ASSERT_EQ(expect_complete(surface_of(decoder, level)), counts.boundary);
  }
}

void expect_same_surface(Decoder& a, Decoder& b) {
  const SurfaceSamples first = surface_of(a, kLevels), second = surface_of(b, kLevels);
  ASSERT_EQ(first.positions, second.positions);
  ASSERT_EQ(first.normals, second.normals);
  ASSERT_EQ(first.indices, second.indices);
}

class EveryPrefix : public testing::TestWithParam<Shape> {
 protected:
  /// Some dozens of bytes to some two thousand.
  static Sample sample(bool embedded) {
    const std::size_t triangles = GetParam().mesh.triangles.size();
    // A tetrahedron's surface is so much smaller than itself that area weights lengthen its steps.
    const double step = triangles > 30 ? 1e-2 : triangles > 4 ? 1e-3 : 3e-4;
    return sample_stream(GetParam(), {embedded, kLevels, step});
  }
};

// The base is known from the end of its connectivity and sharp tags on. Of the last
// four bytes that a decoder reads there, some may not matter.
TEST_P(EveryPrefix, OfAnEmbeddedStreamWantsMoreBytesOrIsASurface) {
  const Sample sample = EveryPrefix::sample(true);
  const std::vector<std::uint8_t>& bytes = sample.stream.bytes;
  ASSERT_GT(bytes.size(), 40u);
  ASSERT_LT(bytes.size(), 3000u);
  const std::size_t base_end = sample.stream.pass_ends.front().bytes;
  ASSERT_EQ(sample.stream.pass_ends.front().pass, bitstream::Pass::sharp_tags);
  const std::vector<Expected> expected = expected_levels(sample.base);
  Decoder bytewise;
  bool was_ready = false;
  for (std::size_t size = 0; size <= bytes.size(); ++size) {
    SCOPED_TRACE(size);
    const ExactBytes prefix(bytes, size);
    Decoder decoder;
    ASSERT_EQ(zt_feed(decoder.get(), prefix.data.get(), prefix.size),
              size < bytes.size() ? ZT_MORE_BYTES_WANTED : ZT_DONE)
        << decoder.reason();
    if (size > 0) zt_feed(bytewise.get(), &bytes[size - 1], 1);
    ASSERT_EQ(bytewise.status(), decoder.status());
    ASSERT_EQ(bytewise.info().base_ready, decoder.info().base_ready);
    const bool ready = decoder.info().base_ready == 1;
    ASSERT_EQ(ready, size >= base_end || (size + 4 > base_end && ready));
    ASSERT_TRUE(ready || !was_ready);
    was_ready = ready;
    if (!ready) {
      ASSERT_EQ(zt_vertex_count(decoder.get(), 0), 0u);
      ASSERT_EQ(zt_reconstruct(decoder.get(), 0, nullptr, 0, nullptr, 0, 0), ZT_NOT_READY);
    } else {
      ASSERT_NO_FATAL_FAILURE(expect_surface(decoder, expected));
      ASSERT_NO_FATAL_FAILURE(expect_same_surface(decoder, bytewise));
    }
  }
}

TEST_P(EveryPrefix, OfAPayloadIsASurface) {
  const Sample sample = EveryPrefix::sample(false);
  const std::vector<std::uint8_t>& bytes = sample.stream.bytes;
  ASSERT_GT(bytes.size(), 40u);
  ASSERT_LT(bytes.size(), 3000u);
  const std::vector<Expected> expected = expected_levels(sample.base);
  Decoder bytewise = decoder_for(sample, false);
  for (std::size_t size = 0; size <= bytes.size(); ++size) {
    SCOPED_TRACE(size);
    const ExactBytes prefix(bytes, size);
    Decoder decoder = decoder_for(sample, false);
    ASSERT_EQ(zt_feed(decoder.get(), prefix.data.get(), prefix.size),
              size < bytes.size() ? ZT_MORE_BYTES_WANTED : ZT_DONE)
        << decoder.reason();
    if (size > 0) zt_feed(bytewise.get(), &bytes[size - 1], 1);
    ASSERT_EQ(bytewise.status(), decoder.status());
    ASSERT_EQ(decoder.info().base_ready, 1);
    ASSERT_NO_FATAL_FAILURE(expect_surface(decoder, expected));
    ASSERT_NO_FATAL_FAILURE(expect_same_surface(decoder, bytewise));
  }
}

// The smooth limit surface of the base: no details, and no sharp tag that only the stream holds.
TEST_P(EveryPrefix, OfNoBytesIsTheSmoothSurfaceOfTheBase) {
  const Sample sample = EveryPrefix::sample(false);
  bitstream::BaseTopology smooth = sample.base;
  smooth.crease_edges.clear();
  smooth.corner_vertices.clear();
  const surface::SubdivisionHierarchy hierarchy(smooth, kLevels, {});
  surface::Positions points = sample.stream.base_positions;
  for (int level = 0; level < kLevels; ++level)
    points = surface::subdivide(hierarchy.level(level), points);
  std::vector<float> limit(points.size());
  surface::limit_surface(hierarchy.level(kLevels), points, {limit.data()}, {});

  Decoder decoder = decoder_for(sample, false);
  EXPECT_EQ(decoder.status(), ZT_MORE_BYTES_WANTED);
  const std::vector<float> smooth_positions = surface_of(decoder, kLevels).positions;
  ASSERT_EQ(smooth_positions.size(), limit.size());
  for (std::size_t i = 0; i < limit.size(); ++i)
    EXPECT_NEAR(smooth_positions[i], limit[i], 1e-5f);  // of coordinates up to 8
  // Bytes that end within the header change nothing.
  decoder.feed(std::span(sample.stream.bytes).first(10));
  EXPECT_EQ(decoder.info().header_ready, 0);
  EXPECT_EQ(surface_of(decoder, kLevels).positions, smooth_positions);
  decoder.feed(std::span(sample.stream.bytes).subspan(10));
  EXPECT_EQ(decoder.status(), ZT_DONE);
  EXPECT_NE(surface_of(decoder, kLevels).positions, smooth_positions);
}

INSTANTIATE_TEST_SUITE_P(Shapes, EveryPrefix, testing::ValuesIn(base_shapes()),
                         [](const auto& shape) { return shape.param.name; });

TEST(ExternalBase, MustHaveTheLevelsOfTheStream) {
  const Sample sample = sample_stream(base_shapes()[0], {false, kLevels});
  Decoder decoder(sample.stream.base_positions, flat_indices(sample.base), kLevels + 1);
  EXPECT_EQ(decoder.feed(sample.stream.bytes), ZT_BROKEN);
  EXPECT_STREQ(decoder.reason(), "the stream has 2 levels where 3 were announced");
}

TEST(ExternalBase, IsCheckedBeforeTheFirstByte) {
  const Sample sample = sample_stream(base_shapes()[0], {false, kLevels});
  const std::vector<float>& positions = sample.stream.base_positions;
  std::vector<std::uint32_t> indices = flat_indices(sample.base);
  zt_options limits = default_options();
  limits.max_vertices = 100;
  EXPECT_EQ(Decoder(positions, indices, kLevels, limits).status(), ZT_BROKEN);
  EXPECT_EQ(Decoder(positions, indices, 15).status(), ZT_BROKEN);
  EXPECT_EQ(Decoder(positions, indices, -1).status(), ZT_BROKEN);
  indices[0] = 1000000;
  Decoder hostile(positions, indices, kLevels);
  EXPECT_EQ(hostile.status(), ZT_BROKEN);
  EXPECT_EQ(zt_vertex_count(hostile.get(), 0), 0u);
  SurfaceSamples surface;
  EXPECT_EQ(hostile.reconstruct(0, surface), ZT_BROKEN_STREAM);
  // Two fans at vertex 0: no surface, though every edge is right.
  const std::vector<float> bow_tie_points(15);
  Decoder bow_tie(bow_tie_points, std::vector<std::uint32_t>{0, 1, 2, 0, 3, 4}, 0);
  EXPECT_EQ(bow_tie.reconstruct(0, surface), ZT_BROKEN_STREAM);
  EXPECT_EQ(bow_tie.status(), ZT_BROKEN);
}

}  // namespace
}  // namespace zerotree::test
