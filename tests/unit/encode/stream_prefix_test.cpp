// Prefixes, pieces and broken bytes.
#include <gtest/gtest.h>

#include <cstdlib>
#include <random>

#include "random_content.h"

namespace zerotree {
namespace {

using bitstream::CoefficientSet;
using bitstream::DecodeStatus;
using bitstream::StreamDecoder;
using encode::StreamBytes;
using encode::StreamContent;

StreamContent small_content(const test::Shape& shape, bool embedded) {
  StreamContent content = test::empty_content(test::canonical_base(shape), 2, embedded, 1);
  test::add_laplacian_details(content, 0.8, 4.0, 3);
  return content;
}

// Half the width of the interval that a midpoint value stands for: its lowest set bit.
std::int64_t half_width(std::int32_t value) {
  return value & -std::int64_t{value};
}

// A coefficient known in part must hold the final one in its interval.
bool refines_to(std::int32_t partial, std::int32_t full) {
  if (partial == 0) return true;
  if ((partial < 0) != (full < 0) || full == 0) return false;
  return std::abs(std::int64_t{partial} - full) < half_width(partial) || partial == full;
}

void expect_refines(const CoefficientSet& partial, const CoefficientSet& full) {
  if (partial.base_edge_count == 0) return;
  for (int c = 0; c < bitstream::kChannelCount; ++c) {
    for (std::size_t i = 0; i < full.channels[c].size(); ++i) {
      ASSERT_TRUE(refines_to(partial.channels[c][i], full.channels[c][i]))
          << partial.channels[c][i] << " " << full.channels[c][i];
    }
  }
}

TEST(StreamPrefix, EveryLengthDecodesAndPiecesEqualTheWhole) {
  for (const test::Shape& shape : test::base_shapes()) {
    for (const bool embedded : {true, false}) {
      const StreamContent content = small_content(shape, embedded);
      const std::vector<std::uint8_t> bytes = encode_stream(content).bytes;
      StreamDecoder pieces = test::decoder_for(content);
      CoefficientSet previous;
      bool base_was_ready = false;
      for (std::size_t n = 0; n <= bytes.size(); ++n) {
        const std::vector<std::uint8_t> prefix(bytes.begin(), bytes.begin() + n);
        StreamDecoder whole = test::decoder_for(content);
        whole.feed(prefix);
        if (n > 0) pieces.feed(std::span(bytes).subspan(n - 1, 1));
        ASSERT_NE(whole.status(), DecodeStatus::broken) << whole.reason();
        ASSERT_EQ(whole.status(), pieces.status());
        ASSERT_EQ(whole.base_ready(), pieces.base_ready());
        ASSERT_TRUE(whole.base_ready() || !base_was_ready);
        base_was_ready = whole.base_ready();
        ASSERT_EQ(whole.coefficients().channels, pieces.coefficients().channels) << n;
        ASSERT_EQ(whole.base_positions(), pieces.base_positions()) << n;
        expect_refines(whole.coefficients(), content.coefficients);
        expect_refines(previous, whole.coefficients());
        previous = whole.coefficients();
      }
      EXPECT_EQ(pieces.status(), DecodeStatus::done);
      EXPECT_EQ(previous.channels, content.coefficients.channels);
    }
  }
}

TEST(StreamPrefix, RandomPiecesEqualTheWhole) {
  std::mt19937 random(8);
  for (const test::Shape& shape : test::base_shapes()) {
    StreamContent content = test::empty_content(test::canonical_base(shape), 4, true, 1);
    test::add_laplacian_details(content, 0.5, 3.0, 9);
    const std::vector<std::uint8_t> bytes = encode_stream(content).bytes;
    StreamDecoder decoder;
    for (std::size_t begin = 0; begin < bytes.size();) {
      const std::size_t size = std::min<std::size_t>(random() % 200, bytes.size() - begin);
      decoder.feed(std::span(bytes).subspan(begin, size));
      begin += size;
    }
    ASSERT_EQ(decoder.status(), DecodeStatus::done);
    EXPECT_EQ(decoder.coefficients().channels, content.coefficients.channels);
  }
}

TEST(StreamPrefix, PassEndsTellWhatAPrefixHolds) {
  StreamContent content =
      test::empty_content(test::canonical_base(test::base_shapes()[0]), 3, true, 1);
  test::add_laplacian_details(content, 0.5, 4.0, 3);
  const StreamBytes stream = encode_stream(content);
  std::size_t previous = 0;
  for (const encode::PassEnd& end : stream.pass_ends) {
    EXPECT_GE(end.bytes, previous);
    previous = end.bytes;
    if (end.pass != bitstream::Pass::cleanup) continue;
    StreamDecoder decoder;
    decoder.feed(std::span(stream.bytes).first(end.bytes));
    const std::int32_t half = 1 << end.plane;
    for (int c = 0; c < bitstream::kChannelCount; ++c) {
      const auto partial = decoder.coefficients().channels[c];
      for (std::size_t i = 0; i < partial.size(); ++i) {
        const std::int32_t full = content.coefficients.channels[c][i];
        // Insignificant in this plane, or within half the plane's interval.
        if (std::abs(full) < 2 * half) continue;
        ASSERT_NE(partial[i], 0);
        ASSERT_LE(std::abs(partial[i] - full), half);
      }
    }
  }
  EXPECT_EQ(previous, stream.bytes.size());
  EXPECT_EQ(stream.pass_ends.back().pass, bitstream::Pass::last_positions);
}

TEST(StreamDecoder, IgnoresWhatFollowsTheEnd) {
  const StreamContent content = small_content(test::base_shapes()[0], true);
  std::vector<std::uint8_t> bytes = encode_stream(content).bytes;
  const std::size_t length = bytes.size();
  bytes.insert(bytes.end(), 100, 0x5a);
  StreamDecoder decoder;
  EXPECT_EQ(decoder.feed(bytes), DecodeStatus::done);
  EXPECT_EQ(decoder.bytes_consumed(), length);
  EXPECT_EQ(decoder.coefficients().channels, content.coefficients.channels);
}

TEST(StreamDecoder, RefusesTheWrongBase) {
  const test::Shape shape = test::base_shapes()[0];
  const StreamContent content = small_content(shape, false);
  const std::vector<std::uint8_t> bytes = encode_stream(content).bytes;
  std::vector<float> positions = test::external_positions(content.base);
  positions.back() += 1e-6f;
  StreamDecoder moved(content.base, positions);
  EXPECT_EQ(moved.feed(bytes), DecodeStatus::broken);
  EXPECT_EQ(moved.reason(), "the base mesh given is not the one that the stream was made for");
  bitstream::BaseTopology turned = content.base;
  std::swap(turned.triangles[0][0], turned.triangles[0][1]);
  StreamDecoder other(turned, test::external_positions(content.base));
  EXPECT_EQ(other.feed(bytes), DecodeStatus::broken);
  StreamDecoder none;
  EXPECT_EQ(none.feed(bytes), DecodeStatus::broken);
  StreamDecoder needless(content.base, test::external_positions(content.base));
  EXPECT_EQ(needless.feed(encode_stream(small_content(shape, true)).bytes), DecodeStatus::broken);
}

TEST(StreamDecoder, RefusesBeforeItTakesMemory) {
  const test::Shape shape = test::base_shapes()[0];
  StreamContent content = test::empty_content(test::canonical_base(shape), 4, true, 1);
  const std::vector<std::uint8_t> bytes = encode_stream(content).bytes;
  StreamDecoder few({.max_vertices = 1000});
  EXPECT_EQ(few.feed(bytes), DecodeStatus::broken);
  StreamDecoder small({.max_memory = 10000});
  EXPECT_EQ(small.feed(bytes), DecodeStatus::broken);
  EXPECT_FALSE(small.reason().empty());
}

TEST(StreamDecoder, BrokenBytesNeverCrash) {
  std::mt19937 random(12);
  for (const test::Shape& shape : test::base_shapes()) {
    for (const bool embedded : {true, false}) {
      const StreamContent content = small_content(shape, embedded);
      const std::vector<std::uint8_t> good = encode_stream(content).bytes;
      for (int round = 0; round < 60; ++round) {
        std::vector<std::uint8_t> bytes = good;
        // Mostly behind the header, whose own test is elsewhere.
        const std::size_t first = round % 4 == 0 ? 2 : 15;
        for (int change = 0; change < 4; ++change) {
          bytes[first + random() % (bytes.size() - first)] = static_cast<std::uint8_t>(random());
        }
        StreamDecoder decoder = test::decoder_for(content);
        for (std::size_t begin = 0; begin < bytes.size(); begin += 97) {
          decoder.feed(
              std::span(bytes).subspan(begin, std::min<std::size_t>(97, bytes.size() - begin)));
        }
        EXPECT_EQ(decoder.status() == DecodeStatus::broken, !decoder.reason().empty());
      }
    }
  }
}

}  // namespace
}  // namespace zerotree
