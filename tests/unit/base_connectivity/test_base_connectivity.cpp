#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "bitstream/base_connectivity_coding.h"
#include "bitstream/base_edges.h"
#include "bitstream/base_traversal.h"
#include "bitstream/range_decoder.h"
#include "bitstream/sharp_tag_coding.h"
#include "encode/range_encoder.h"
#include "random_topology.h"
#include "shapes.h"

namespace zerotree::bitstream {
namespace {

using Bytes = std::vector<std::uint8_t>;

BaseTopology topology_of(const TriangleMesh& mesh) {
  return {static_cast<std::uint32_t>(mesh.positions.size()), mesh.triangles, {}, {}};
}

BaseTopology topology_of(const test::Shape& shape) {
  BaseTopology result = topology_of(shape.mesh);
  result.crease_edges = shape.crease_edges;
  result.corner_vertices = shape.corner_vertices;
  return result;
}

BaseTopology canonical(const BaseTopology& topology) {
  return reorder(topology, canonical_base_order(topology));
}

BaseCounts counts_of(const BaseTopology& topology) {
  return {topology.vertex_count, static_cast<std::uint32_t>(topology.triangles.size())};
}

void expect_equal(const BaseTopology& a, const BaseTopology& b) {
  EXPECT_EQ(a.vertex_count, b.vertex_count);
  EXPECT_EQ(a.triangles, b.triangles);
  EXPECT_EQ(a.crease_edges, b.crease_edges);
  EXPECT_EQ(a.corner_vertices, b.corner_vertices);
}

/// Connectivity and, if there are any, sharp tags.
Bytes encode(const BaseTopology& topology) {
  encode::RangeEncoder coder;
  EXPECT_EQ(encode_base_connectivity(coder, topology).problem, nullptr);
  if (topology.crease_edges.size() + topology.corner_vertices.size() > 0) {
    const BaseEdges numbering = number_base_edges(topology);
    SharpTagCoding tags(numbering.edges, topology.vertex_count);
    tags.set_tags(topology);
    tags.code(coder);
  }
  return coder.finish();
}

/// Codes `topology` in canonical order and back; returns the bits per vertex, whole bytes counted.
double round_trip(const BaseTopology& topology) {
  EXPECT_EQ(check_base_topology(topology).problem, nullptr);
  const BaseTopology ordered = canonical(topology);
  expect_equal(canonical(ordered), ordered);
  const Bytes bytes = encode(ordered);
  RangeDecoder decoder(bytes);
  BaseTopology decoded;
  EXPECT_EQ(decode_base_connectivity(decoder, counts_of(ordered), decoded).problem, nullptr);
  if (ordered.crease_edges.size() + ordered.corner_vertices.size() > 0) {
    const BaseEdges numbering = number_base_edges(decoded);
    SharpTagCoding tags(numbering.edges, decoded.vertex_count);
    EXPECT_TRUE(tags.code(decoder));
    tags.get_tags(decoded);
  }
  EXPECT_EQ(decoder.sequence_length(), bytes.size());
  expect_equal(decoded, ordered);
  return 8.0 * static_cast<double>(bytes.size()) / topology.vertex_count;
}

/// Valences as decimation leaves them: mostly 5 to 7, some 4 and 8.
BaseTopology like_decimated(int subdivisions, std::uint32_t seed) {
  const BaseTopology sphere = topology_of(test::sphere(subdivisions));
  return test::flip_edges(sphere, sphere.vertex_count * 2, 4, 8, seed);
}

TEST(BaseConnectivity, EveryShapeComesBackExactly) {
  for (const test::Shape& shape : test::base_shapes()) {
    SCOPED_TRACE(shape.name);
    const BaseTopology topology = topology_of(shape);
    const double rate = round_trip(topology);
    std::printf("%-16s %5u vertices  %.2f bits per vertex\n", shape.name.c_str(),
                topology.vertex_count, rate);
    for (std::uint32_t seed = 1; seed <= 20; ++seed) round_trip(test::shuffle(topology, seed));
  }
}

TEST(BaseConnectivity, DecimatedBasesCostAtMostFourBitsPerVertex) {
  for (const int subdivisions : {2, 3, 4}) {
    double total = 0;
    for (std::uint32_t seed = 1; seed <= 10; ++seed) {
      const double rate = round_trip(test::shuffle(like_decimated(subdivisions, seed), seed));
      EXPECT_LE(rate, 4.0);
      total += rate;
    }
    std::printf("%5d vertices  %.2f bits per vertex\n", 10 * (1 << 2 * subdivisions) + 2,
                total / 10);
    EXPECT_LE(total / 10, 3.5);
  }
}

TEST(BaseConnectivity, WildValencesComeBack) {
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    const BaseTopology sphere = topology_of(test::sphere(2));
    round_trip(test::flip_edges(sphere, 2000, 3, 40, seed));
  }
  round_trip(topology_of(test::bipyramid(300)));
}

TEST(BaseConnectivity, BoundariesComeBackWithinTheLimit) {
  for (std::uint32_t seed = 1; seed <= 10; ++seed) {
    const BaseTopology few = test::punch_holes(like_decimated(2, seed), 5, seed);
    EXPECT_LE(round_trip(few), 4.0);
    round_trip(test::shuffle(test::punch_holes(like_decimated(2, seed), 150, seed), seed));
    round_trip(test::punch_holes(test::torus(5, 6), 40, seed));
  }
}

TEST(BaseConnectivity, HandlesComeBack) {
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    const BaseTopology torus = test::torus(4 + seed % 5, 3 + seed % 7);
    round_trip(test::shuffle(torus, seed));
    round_trip(test::flip_edges(torus, 300, 3, 12, seed));
  }
}

TEST(BaseConnectivity, ManyComponentsComeBack) {
  BaseTopology all = topology_of(test::tetrahedron());
  for (std::uint32_t i = 0; i < 30; ++i) {
    const BaseTopology single{3, {{0, 1, 2}}, {}, {}};
    all = test::join(all, i % 3 == 0   ? test::torus(3 + i % 4, 4)
                          : i % 3 == 1 ? topology_of(test::grid(2, 2))
                                       : single);
  }
  round_trip(all);
  for (std::uint32_t seed = 1; seed <= 10; ++seed) round_trip(test::shuffle(all, seed));
}

TEST(BaseConnectivity, CreasesAndCornersComeBack) {
  for (std::uint32_t seed = 1; seed <= 10; ++seed) {
    const BaseTopology base = test::punch_holes(like_decimated(2, seed), 8, seed);
    for (const double share : {0.02, 0.3, 1.0}) round_trip(test::tag_randomly(base, share, seed));
  }
}

/// Counts the decisions of an encoder.
struct CountingCoder {
  int raw = 0;
  int adaptive = 0;
  bool code(bool bit, AdaptiveBit&) { return ++adaptive, bit; }
  bool code_raw(bool bit) { return ++raw, bit; }
  static bool starved() { return false; }
};

TEST(BaseConnectivity, OneTriangleIsOneBit) {
  CountingCoder one_triangle;
  EXPECT_TRUE(encode_base_connectivity(one_triangle, {3, {{0, 1, 2}}, {}, {}}).ok());
  EXPECT_EQ(one_triangle.raw, 1);  // it has a boundary
  EXPECT_EQ(one_triangle.adaptive, 0);
}

TEST(BaseConnectivity, LargeMeshesTakeLinearTime) {
  const BaseTopology large = test::flip_edges(topology_of(test::sphere(6)), 40000, 4, 9, 3);
  const double rate = round_trip(large);
  std::printf("%5u vertices  %.2f bits per vertex\n", large.vertex_count, rate);
  EXPECT_LE(rate, 4.0);
}

TEST(BaseConnectivity, EncoderRefusesAnotherOrder) {
  const BaseTopology other = test::shuffle(like_decimated(1, 1), 5);
  encode::RangeEncoder coder;
  EXPECT_FALSE(encode_base_connectivity(coder, other).ok());
}

TEST(BaseConnectivity, CheckFindsWhatIsNoManifold) {
  const auto problem = [](BaseTopology topology) { return !check_base_topology(topology).ok(); };
  EXPECT_FALSE(problem({3, {{0, 1, 2}}, {}, {}}));
  EXPECT_TRUE(problem({4, {{0, 1, 2}}, {}, {}}));                        // unused vertex
  EXPECT_TRUE(problem({2, {{0, 1, 2}}, {}, {}}));                        // index too large
  EXPECT_TRUE(problem({3, {{0, 1, 1}}, {}, {}}));                        // degenerate
  EXPECT_TRUE(problem({4, {{0, 1, 2}, {0, 1, 3}}, {}, {}}));             // turned over
  EXPECT_TRUE(problem({5, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}, {}, {}}));  // three at an edge
  EXPECT_TRUE(problem({5, {{0, 1, 2}, {0, 3, 4}}, {}, {}}));             // two fans
  EXPECT_TRUE(problem({3, {{0, 1, 2}}, {{0, 1}}, {}}));                  // crease on the boundary
  EXPECT_TRUE(problem({3, {{0, 1, 2}}, {}, {3}}));                       // corner without vertex
  EXPECT_FALSE(problem({4, {{0, 1, 2}, {1, 0, 3}}, {{0, 1}}, {0, 2}}));
  EXPECT_TRUE(problem({4, {{0, 1, 2}, {1, 0, 3}}, {{0, 1}, {0, 1}}, {}}));
}

/// Whatever the bytes, the decoder ends with a checked topology of these counts or a problem.
bool decode_any(const Bytes& bytes, BaseCounts counts) {
  RangeDecoder decoder(bytes);
  BaseTopology decoded;
  if (!decode_base_connectivity(decoder, counts, decoded).ok()) return false;
  EXPECT_EQ(decoded.vertex_count, counts.vertices);
  EXPECT_EQ(decoded.triangles.size(), counts.triangles);
  EXPECT_EQ(check_base_topology(decoded).problem, nullptr);
  return true;
}

std::uint32_t below(std::mt19937& random, std::uint32_t bound) {
  return static_cast<std::uint32_t>(random() % bound);
}

TEST(BaseConnectivity, RandomBytesNeverBreakTheDecoder) {
  std::mt19937 random(11);
  int accepted = 0;
  for (int round = 0; round < 5000; ++round) {
    Bytes bytes(below(random, 100));
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random());
    const std::uint32_t vertices = below(random, round % 2 ? 60 : 8);
    accepted += decode_any(bytes, {vertices, below(random, 2 * vertices + 2)});
  }
  EXPECT_GT(accepted, 0);
  EXPECT_LT(accepted, 5000);
}

TEST(BaseConnectivity, CorruptBytesNeverBreakTheDecoder) {
  std::mt19937 random(12);
  int refused = 0;
  std::vector<BaseTopology> bases;
  for (std::uint32_t seed = 0; seed < 8; ++seed) {
    const BaseTopology base =
        seed % 2 ? test::torus(5, 4) : test::punch_holes(like_decimated(1, seed), 6, 1);
    bases.push_back(canonical(test::tag_randomly(base, 0.1, 1)));
  }
  for (std::uint32_t round = 0; round < 3000; ++round) {
    const BaseTopology& base = bases[round % bases.size()];
    Bytes bytes = encode(base);
    for (std::uint32_t changes = 1 + below(random, 4); changes > 0; --changes) {
      bytes[below(random, static_cast<std::uint32_t>(bytes.size()))] ^=
          static_cast<std::uint8_t>(1u << below(random, 8));
    }
    BaseCounts counts = counts_of(base);
    if (round % 7 == 0) counts.vertices += below(random, 5) - 2;
    if (round % 11 == 0) counts.triangles = below(random, 100);
    refused += !decode_any(bytes, counts);
  }
  EXPECT_GT(refused, 1000);
}

TEST(BaseConnectivity, EveryShorterSequenceIsRefused) {
  const BaseTopology base = canonical(like_decimated(1, 2));
  const Bytes bytes = encode(base);
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    EXPECT_FALSE(decode_any(Bytes(bytes.data(), bytes.data() + length), counts_of(base))) << length;
  }
  EXPECT_TRUE(decode_any(bytes, counts_of(base)));
}

TEST(BaseConnectivity, GoesOnWhereBytesWereMissing) {
  for (std::uint32_t seed = 1; seed <= 5; ++seed) {
    const BaseTopology base = canonical(test::punch_holes(test::torus(6, 7), seed, seed));
    const Bytes bytes = encode(base);
    RangeDecoder decoder;
    BaseConnectivityCoder<RangeDecoder> pieces(decoder);
    BaseTopology decoded;
    std::size_t triangles = 0;
    for (std::size_t length = 0; length < bytes.size(); ++length) {
      if (length > 0) decoder.add_bytes(std::span(bytes).subspan(length - 1, 1));
      EXPECT_FALSE(pieces.decode(counts_of(base), decoded).ok());
      EXPECT_TRUE(pieces.starved());
      EXPECT_GE(decoded.triangles.size(), triangles);
      triangles = decoded.triangles.size();
    }
    decoder.add_bytes(std::span(bytes).last(1));
    EXPECT_TRUE(pieces.decode(counts_of(base), decoded).ok());
    expect_equal(decoded, base);
  }
}

TEST(BaseConnectivity, HugeCountsAllocateNothing) {
  EXPECT_FALSE(decode_any({}, {4000000000u, 4000000000u}));
  EXPECT_FALSE(decode_any(Bytes(64, 0x5a), {4000000000u, 4000000000u}));
  EXPECT_FALSE(decode_any(Bytes(8, 0), {0, 5}));
  EXPECT_FALSE(decode_any(Bytes(8, 0), {2, 1}));
  EXPECT_TRUE(decode_any(encode({3, {{0, 1, 2}}, {}, {}}), {3, 1}));
}

}  // namespace
}  // namespace zerotree::bitstream
