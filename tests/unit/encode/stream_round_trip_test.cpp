// What is coded comes back, on every class of base.
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "mesh/error.h"
#include "random_content.h"

namespace zerotree {
namespace {

using bitstream::DecodeStatus;
using bitstream::StreamDecoder;
using encode::StreamBytes;
using encode::StreamContent;

void expect_round_trip(const StreamContent& content, const std::string& what) {
  const StreamBytes stream = encode_stream(content);
  StreamDecoder decoder = test::decoder_for(content);
  ASSERT_EQ(decoder.feed(stream.bytes), DecodeStatus::done) << what << ": " << decoder.reason();
  EXPECT_EQ(decoder.bytes_consumed(), stream.bytes.size()) << what;
  EXPECT_EQ(decoder.coefficients().channels, content.coefficients.channels) << what;
  EXPECT_EQ(decoder.base().triangles, content.base.triangles) << what;
  EXPECT_EQ(decoder.base().crease_edges, content.base.crease_edges) << what;
  EXPECT_EQ(decoder.base().corner_vertices, content.base.corner_vertices) << what;
  const std::vector<float> positions = decoder.base_positions();
  if (content.header.external_base) {
    EXPECT_EQ(positions, test::external_positions(content.base)) << what;
    return;
  }
  ASSERT_EQ(positions.size(), content.positions.size()) << what;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const double scale = double{content.header.positions.scale};
    const double origin = content.header.positions.origin[i % 3] *
                          std::ldexp(scale, bitstream::origin_shift(content.header.positions.bits));
    ASSERT_NEAR(double{positions[i]}, origin + (content.positions[i] + 0.5) * scale, 1e-5) << what;
  }
}

TEST(StreamRoundTrip, EveryShapeLevelAndDensity) {
  for (const test::Shape& shape : test::base_shapes()) {
    const bitstream::BaseTopology base = test::canonical_base(shape);
    for (int levels = 0; levels <= 4; ++levels) {
      for (const bool embedded : {true, false}) {
        for (const double density : {0.0, 0.01, 0.3, 1.0}) {
          StreamContent content = test::empty_content(base, levels, embedded, 1);
          test::add_random_details(content, density, 9, 2);
          expect_round_trip(content, shape.name + " levels " + std::to_string(levels) +
                                         (embedded ? " embedded " : " external ") +
                                         std::to_string(density));
        }
      }
    }
  }
}

TEST(StreamRoundTrip, ExtremeValues) {
  const bitstream::BaseTopology base = test::canonical_base(test::base_shapes().front());
  StreamContent content = test::empty_content(base, 3, true, 1);
  auto& normal = content.coefficients.channels[bitstream::kNormal];
  auto& tangent = content.coefficients.channels[bitstream::kTangent2];
  normal.front() = 0x7fffffff;
  normal.back() = -0x7fffffff;
  tangent[tangent.size() / 2] = 3;
  tangent.back() = -3;
  expect_round_trip(content, "extreme values");
}

TEST(StreamRoundTrip, MoreAndFewerPositionPlanesThanDetailPlanes) {
  const bitstream::BaseTopology base = test::canonical_base(test::base_shapes().front());
  for (const int bits : {1, 3, 20}) {
    for (const int initial : {0, 11}) {
      StreamContent content = test::empty_content(base, 2, true, 1);
      content.header.positions.initial_planes = initial;
      test::add_random_details(content, 0.5, bits, 3);
      expect_round_trip(content, "planes");
    }
  }
}

TEST(StreamEncoder, IsDeterministic) {
  for (const test::Shape& shape : test::base_shapes()) {
    StreamContent content = test::empty_content(test::canonical_base(shape), 3, true, 4);
    test::add_laplacian_details(content, 0.7, 3.0, 5);
    EXPECT_EQ(encode_stream(content).bytes, encode_stream(content).bytes);
  }
}

// Any change of the format shows here; then the format version must change too.
TEST(StreamEncoder, GoldenBytes) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  std::size_t size = 0;
  for (const test::Shape& shape : test::base_shapes()) {
    for (const bool embedded : {true, false}) {
      StreamContent content = test::empty_content(test::canonical_base(shape), 3, embedded, 6);
      test::add_random_details(content, 0.2, 8, 7);
      for (const std::uint8_t byte : encode_stream(content).bytes) {
        hash = (hash ^ byte) * 0x100000001b3u;
        ++size;
      }
    }
  }
  EXPECT_EQ(size, 11719u);
  EXPECT_EQ(hash, 4984409112501784000u);
}

TEST(StreamEncoder, RefusesContentThatContradictsItself) {
  const bitstream::BaseTopology base = test::canonical_base(test::base_shapes().front());
  const StreamContent good = test::empty_content(base, 2, true, 1);
  StreamContent even = good;
  even.coefficients.channels[0][0] = 4;
  EXPECT_THROW(encode_stream(even), std::invalid_argument);
  StreamContent one = good;
  one.coefficients.channels[1][0] = -1;
  EXPECT_THROW(encode_stream(one), std::invalid_argument);
  StreamContent deep = good;
  deep.header.levels = 3;
  EXPECT_THROW(encode_stream(deep), std::invalid_argument);
  StreamContent wide = good;
  wide.positions[0] = 1u << 11;
  EXPECT_THROW(encode_stream(wide), std::invalid_argument);
  StreamContent shuffled = good;
  std::swap(shuffled.base.triangles.front(), shuffled.base.triangles.back());
  EXPECT_THROW(encode_stream(shuffled), Error);
}

}  // namespace
}  // namespace zerotree
