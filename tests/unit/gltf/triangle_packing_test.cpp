#include "gltf/triangle_packing.h"

#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include <algorithm>
#include <random>

#include "sample_assets.h"

namespace zerotree::gltf {
namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

// With meshoptimizer's decoder, which is what viewers have.
Triangles unpack(const std::vector<std::uint8_t>& packed, std::size_t count) {
  Triangles triangles(count);
  EXPECT_EQ(meshopt_decodeIndexBuffer(triangles.data(), 3 * count, 4, packed.data(), packed.size()),
            0);
  return triangles;
}

TEST(TrianglePacking, KeepsOrderAndFirstCorners) {
  for (const test::Shape& shape : test::base_shapes()) {
    EXPECT_EQ(unpack(pack_triangles(shape.mesh.triangles), shape.mesh.triangles.size()),
              shape.mesh.triangles)
        << shape.name;
    const Triangles ordered = test::in_canonical_order(shape.mesh).triangles;
    EXPECT_EQ(unpack(pack_triangles(ordered), ordered.size()), ordered) << shape.name;
  }
}

TEST(TrianglePacking, KeepsTrianglesInAnyOrder) {
  std::mt19937 random(5);
  for (int round = 0; round < 200; ++round) {
    Triangles triangles = test::sphere(2).triangles;
    std::shuffle(triangles.begin(), triangles.end(), random);
    for (auto& triangle : triangles)
      std::rotate(triangle.begin(), triangle.begin() + std::ptrdiff_t(random() % 3),
                  triangle.end());
    EXPECT_EQ(unpack(pack_triangles(triangles), triangles.size()), triangles);
  }
}

TEST(TrianglePacking, KeepsAnyNumbers) {
  std::mt19937 random(6);
  for (int round = 0; round < 2000; ++round) {
    Triangles triangles(1 + random() % 60);
    const auto range = 3 + random() % 40;
    for (auto& triangle : triangles)
      for (std::uint32_t& v : triangle) v = static_cast<std::uint32_t>(random() % range);
    EXPECT_EQ(unpack(pack_triangles(triangles), triangles.size()), triangles);
  }
}

// An old vertex and two new ones have no code of their own.
TEST(TrianglePacking, KeepsTwoNewVerticesAtAnOldOne) {
  const Triangles triangles = {{0, 1, 2}, {0, 3, 4}, {4, 5, 6}, {7, 8, 9}};
  EXPECT_EQ(unpack(pack_triangles(triangles), triangles.size()), triangles);
}

TEST(TrianglePacking, TakesLittleMoreThanAByteInCanonicalOrder) {
  const Triangles triangles = test::in_canonical_order(test::sphere(2)).triangles;
  EXPECT_LT(pack_triangles(triangles).size(), triangles.size() * 3 / 2);
}

}  // namespace
}  // namespace zerotree::gltf
