// Positions of an embedded base: they come back whatever they are, and smooth ones are cheap.
#include "bitstream/position_planes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>

#include "bitstream/base_traversal.h"
#include "bitstream/range_decoder.h"
#include "encode/range_encoder.h"
#include "shapes.h"

namespace zerotree::bitstream {
namespace {

using Integers = std::vector<std::uint32_t>;

BaseTopology topology_of(const TriangleMesh& mesh) {
  return {static_cast<std::uint32_t>(mesh.positions.size()), mesh.triangles, {}, {}};
}

std::vector<std::uint8_t> encode_planes(const BaseTopology& base, int bits, const Integers& truth) {
  PositionPlanes planes(base, bits);
  encode::RangeEncoder coder;
  while (planes.unknown_planes() > 0) EXPECT_TRUE(planes.code_plane(coder, truth));
  return coder.finish();
}

// Decodes byte by byte; every value must hold the truth in its interval all the way.
void expect_round_trip(const BaseTopology& base, int bits, const Integers& truth) {
  const std::vector<std::uint8_t> bytes = encode_planes(base, bits, truth);
  PositionPlanes planes(base, bits);
  RangeDecoder decoder;
  for (std::size_t size = 0; size <= bytes.size(); ++size) {
    if (size > 0) decoder.add_bytes(std::span(bytes).subspan(size - 1, 1));
    while (planes.unknown_planes() > 0 && planes.code_plane(decoder, {})) {
    }
    const std::int64_t half = std::int64_t{1} << planes.unknown_planes();
    for (std::size_t i = 0; i < truth.size(); ++i) {
      const std::int64_t middle = 2 * std::int64_t{truth[i]} + 1;
      ASSERT_LT(std::abs(middle - planes.values()[i]), half) << size;
    }
  }
  EXPECT_EQ(planes.unknown_planes(), 0);
  EXPECT_EQ(decoder.sequence_length(), bytes.size());
}

Integers random_integers(std::size_t count, int bits, std::uint32_t seed) {
  std::mt19937 random(seed);
  Integers result(count);
  for (std::uint32_t& q : result) q = static_cast<std::uint32_t>(random()) >> (32 - bits);
  return result;
}

TEST(PositionPlanes, AnyIntegersComeBack) {
  for (const TriangleMesh& mesh : {test::tetrahedron(), test::bipyramid(40)}) {
    const BaseTopology base = topology_of(mesh);
    const std::size_t count = std::size_t{base.vertex_count} * 3;
    for (const int bits : {1, 2, 13, kMostPositionBits}) {
      const std::uint32_t most = (std::uint32_t{1} << bits) - 1;
      expect_round_trip(base, bits, Integers(count, 0));
      expect_round_trip(base, bits, Integers(count, most));
      expect_round_trip(base, bits, random_integers(count, bits, 3));
      Integers alternating(count, 0);
      for (std::size_t i = 0; i < count; i += 2) alternating[i] = most;
      expect_round_trip(base, bits, alternating);
    }
  }
}

TEST(PositionPlanes, VerticesWithoutFacesAreAllowed) {
  const BaseTopology base{5, {{0, 1, 2}}, {}, {}};
  expect_round_trip(base, 9, random_integers(15, 9, 1));
}

TEST(PositionPlanes, NoiseCostsHardlyMoreThanItsBits) {
  const BaseTopology base = topology_of(test::sphere(2));
  const Integers noise = random_integers(std::size_t{base.vertex_count} * 3, 16, 5);
  const double raw = 2.0 * static_cast<double>(noise.size());
  EXPECT_LT(static_cast<double>(encode_planes(base, 16, noise).size()), 1.03 * raw);
}

TEST(PositionPlanes, SmoothPositionsAreCheap) {
  constexpr int kBits = 16;
  const TriangleMesh sphere = test::sphere(2);
  const BaseTopology unordered = topology_of(sphere);
  const BaseOrder order = canonical_base_order(unordered);
  Integers integers;
  for (const std::uint32_t old : order.vertices) {
    for (int axis = 0; axis < 3; ++axis) {
      const double unit = 0.499 * sphere.positions[old][axis] / sphere.positions[old].norm() + 0.5;
      integers.push_back(static_cast<std::uint32_t>(std::ldexp(unit, kBits)));
    }
  }
  const double bytes =
      static_cast<double>(encode_planes(reorder(unordered, order), kBits, integers).size());
  const double rate = 8.0 * bytes / static_cast<double>(order.vertices.size());
  std::printf("%.2f bits per vertex, raw %d\n", rate, 3 * kBits);
  EXPECT_LT(rate, 39.5);
}

}  // namespace
}  // namespace zerotree::bitstream
