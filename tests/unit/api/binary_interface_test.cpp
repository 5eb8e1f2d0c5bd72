// Sizes that callers say: of indices, of structs they were compiled with.
#include <gtest/gtest.h>

#include <cstring>
#include <memory>

#include "sample_streams.h"

namespace zerotree::test {
namespace {

TEST(ShortIndices, EqualLongOnes) {
  for (const Shape& shape : base_shapes()) {
    const Sample sample = sample_stream(shape, {true, 2, 1e-2});
    Decoder decoder;
    decoder.feed(sample.stream.bytes);
    for (int level = 0; level <= 2; ++level) {
      const std::uint32_t triangles = zt_triangle_count(decoder.get(), level);
      std::vector<std::uint32_t> longs(3 * std::size_t{triangles});
      // Exactly as much as the contract asks for.
      const std::unique_ptr<std::uint16_t[]> shorts(new std::uint16_t[longs.size()]);
      ASSERT_EQ(zt_get_indices(decoder.get(), level, longs.data(), 4, triangles), ZT_OK);
      ASSERT_EQ(zt_get_indices(decoder.get(), level, shorts.get(), 2, triangles), ZT_OK);
      EXPECT_TRUE(std::equal(longs.begin(), longs.end(), shorts.get()));
      EXPECT_EQ(zt_get_indices(decoder.get(), level, shorts.get(), 2, triangles - 1),
                ZT_INVALID_ARGUMENT);
      for (const std::uint32_t size : {0u, 1u, 3u, 8u})
        EXPECT_EQ(zt_get_indices(decoder.get(), level, longs.data(), size, triangles),
                  ZT_INVALID_ARGUMENT);
    }
  }
}

// 40962 vertices at level 6 of an icosahedron, 163842 at level 7.
TEST(ShortIndices, AreRefusedBeyondTheirRange) {
  const Shape shape = base_shapes()[0];
  std::vector<float> positions;
  for (const Eigen::Vector3d& p : shape.mesh.positions)
    for (int axis = 0; axis < 3; ++axis) positions.push_back(static_cast<float>(p[axis]));
  std::vector<std::uint32_t> indices;
  for (const auto& triangle : shape.mesh.triangles)
    indices.insert(indices.end(), triangle.begin(), triangle.end());
  Decoder decoder(positions, indices, 7);
  const std::uint32_t triangles = zt_triangle_count(decoder.get(), 7);
  std::vector<std::uint16_t> shorts(3 * std::size_t{triangles});
  ASSERT_EQ(zt_vertex_count(decoder.get(), 6), 40962u);
  EXPECT_EQ(zt_get_indices(decoder.get(), 6, shorts.data(), 2, triangles), ZT_OK);
  ASSERT_EQ(zt_vertex_count(decoder.get(), 7), 163842u);
  EXPECT_EQ(zt_get_indices(decoder.get(), 7, shorts.data(), 2, triangles), ZT_INVALID_ARGUMENT);
}

TEST(OptionsOfAnotherSize, AreTakenAsFarAsTheyGo) {
  zt_options options = default_options();
  options.struct_size = 0;
  EXPECT_EQ(zt_create(&options), nullptr);
  const float positions[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  const std::uint32_t indices[3] = {0, 1, 2};
  EXPECT_EQ(zt_create_for_base(positions, 0, 3, indices, 1, 0, &options), nullptr);
  // Some caller's struct that ends after the vertices: what lies behind is not read.
  options.struct_size = offsetof(zt_options, max_memory);
  options.max_vertices = 100;
  std::memset(reinterpret_cast<char*>(&options) + options.struct_size, 0xee,
              sizeof options - options.struct_size);
  zt_decoder* decoder = zt_create_for_base(positions, 0, 3, indices, 1, 2, &options);
  ASSERT_NE(decoder, nullptr);
  EXPECT_EQ(zt_get_status(decoder), ZT_MORE_BYTES_WANTED) << zt_reason(decoder);
  zt_free(decoder);
  decoder = zt_create_for_base(positions, 0, 3, indices, 1, 4, &options);
  EXPECT_EQ(zt_get_status(decoder), ZT_BROKEN);
  zt_free(decoder);
  // And one that is longer.
  struct {
    zt_options known;
    char more[64];
  } longer{};
  longer.known.struct_size = sizeof longer;
  decoder = zt_create(&longer.known);
  EXPECT_NE(decoder, nullptr);
  zt_free(decoder);
}

TEST(AllocatorsOfOneFunction, AreRefused) {
  zt_options options = default_options();
  options.allocator.allocate = [](void*, std::size_t) -> void* { return nullptr; };
  EXPECT_EQ(zt_create(&options), nullptr);
}

TEST(InfoOfAnotherSize, IsFilledAsFarAsItGoes) {
  const Sample sample = sample_stream(base_shapes()[0], {true, 2, 1e-2});
  Decoder decoder;
  decoder.feed(sample.stream.bytes);
  const zt_info whole = decoder.info();
  EXPECT_EQ(whole.base_ready, 1);
  for (std::size_t size = 0; size <= sizeof whole; ++size) {
    const std::unique_ptr<unsigned char[]> part(new unsigned char[size]);
    zt_get_info(decoder.get(), reinterpret_cast<zt_info*>(part.get()), size);
    EXPECT_EQ(std::memcmp(part.get(), &whole, size), 0) << size;
  }
  // A caller's longer struct: zeros where this library knows nothing.
  std::vector<unsigned char> longer(sizeof whole + 40, 0xee);
  zt_get_info(decoder.get(), reinterpret_cast<zt_info*>(longer.data()), longer.size());
  EXPECT_EQ(std::memcmp(longer.data(), &whole, sizeof whole), 0);
  EXPECT_EQ(std::count(longer.begin() + sizeof whole, longer.end(), 0), 40);
  zt_get_info(decoder.get(), nullptr, 8);
  zt_info nothing;
  zt_get_info(nullptr, &nothing, sizeof nothing);
  EXPECT_LT(nothing.error, 0.0f);
  EXPECT_EQ(nothing.memory, 0u);
}

}  // namespace
}  // namespace zerotree::test
