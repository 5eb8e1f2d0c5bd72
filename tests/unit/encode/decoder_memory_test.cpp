// What a decoder takes of memory and when, and what it tells of changes.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <memory_resource>

#include "random_content.h"

namespace zerotree {
namespace {

using bitstream::DecodeStatus;
using bitstream::DetailState;
using bitstream::StreamDecoder;
using encode::StreamContent;

constexpr int kNothing = std::numeric_limits<int>::max();

/// Passes requests on and counts them.
class CountingResource : public std::pmr::memory_resource {
 public:
  std::size_t requests = 0, bytes = 0, most_bytes = 0;

 private:
  void* do_allocate(std::size_t size, std::size_t alignment) override {
    ++requests;
    bytes += size;
    most_bytes = std::max(most_bytes, bytes);
    return std::pmr::new_delete_resource()->allocate(size, alignment);
  }
  void do_deallocate(void* memory, std::size_t size, std::size_t alignment) override {
    bytes -= size;
    std::pmr::new_delete_resource()->deallocate(memory, size, alignment);
  }
  bool do_is_equal(const memory_resource& other) const noexcept override { return this == &other; }
};

StreamContent content_of(const test::Shape& shape, int levels, int bits) {
  StreamContent content = test::empty_content(test::canonical_base(shape), levels, true, 1);
  test::add_random_details(content, 0.2, bits, 5);
  return content;
}

/// The index in its channel of some cell of `level`, which every base has.
std::size_t some_cell(const StreamContent& content, int level) {
  return bitstream::level_offset(content.coefficients.base_edge_count, level);
}

TEST(DecoderMemory, IsTakenWhenTheBaseIsAcceptedAndWithinTheBound) {
  for (const test::Shape& shape : test::base_shapes()) {
    const StreamContent content = content_of(shape, 4, 12);
    const std::vector<std::uint8_t> bytes = encode_stream(content).bytes;
    CountingResource memory;
    {
      StreamDecoder decoder({}, &memory);
      std::size_t before = 0;
      for (std::size_t n = 0; n < bytes.size(); ++n) {
        decoder.feed(std::span(bytes).subspan(n, 1));
        if (decoder.base_ready()) {
          EXPECT_TRUE(before == 0 || memory.requests == before) << shape.name << " byte " << n;
          before = memory.requests;
        }
      }
      EXPECT_EQ(decoder.status(), DecodeStatus::done);
      EXPECT_EQ(decoder.coefficients().channels, content.coefficients.channels);
      const std::uint64_t bound = DetailState::memory(decoder.base_edges().size(), 4, 12);
      const std::uint64_t base = content.base.triangles.size() * 200;
      EXPECT_GT(memory.requests, 4u);
      EXPECT_LE(memory.most_bytes, bound + base) << shape.name;
    }
    EXPECT_EQ(memory.bytes, 0u);
  }
}

TEST(DecoderMemory, FinestLevelsTakeSixteenBytesACell) {
  constexpr std::uint64_t kEdges = 600;
  constexpr int kLevels = 7;
  const std::uint64_t cells = kEdges * bitstream::cells_below(kLevels);
  const double each =
      static_cast<double>(DetailState::memory(kEdges, kLevels, 14)) / static_cast<double>(cells);
  EXPECT_LT(each, 16.1);
  EXPECT_GE(each, 16.0);
}

// With 15 planes or more a value may need 32 bits; at the two finest levels it begins with 16.
TEST(DecoderMemory, ValuesAreWidenedWhereTheyNeedIt) {
  for (const std::int32_t magnitude : {(1 << 14) - 1, 1 << 14, (1 << 15) - 1, (1 << 29) + 12345}) {
    for (const std::int32_t sign : {1, -1}) {
      StreamContent content = content_of(test::base_shapes()[0], 4, 12);
      for (int level = 0; level < 4; ++level) {
        const auto c = static_cast<std::size_t>(level % bitstream::kChannelCount);
        content.coefficients.channels[c][some_cell(content, level)] = sign * (2 * magnitude + 1);
      }
      const std::vector<std::uint8_t> bytes = encode_stream(content).bytes;
      CountingResource memory;
      StreamDecoder decoder({}, &memory);
      EXPECT_EQ(decoder.feed(bytes), DecodeStatus::done);
      EXPECT_EQ(decoder.coefficients().channels, content.coefficients.channels) << magnitude;
      const bool wide = magnitude >= 1 << 14;
      EXPECT_EQ(decoder.details().values(0, 3).is_wide(), wide);
      EXPECT_EQ(decoder.details().values(1, 0).is_wide(), wide);
      EXPECT_FALSE(decoder.details().values(1, 3).is_wide());
      const int planes = decoder.header().planes;
      EXPECT_LE(memory.most_bytes, DetailState::memory(decoder.base_edges().size(), 4, planes) +
                                       content.base.triangles.size() * 200);
    }
  }
}

TEST(DecoderMemory, LevelsWithoutDetailsAreNotTouched) {
  StreamContent content =
      test::empty_content(test::canonical_base(test::base_shapes()[0]), 5, true, 1);
  content.coefficients.channels[bitstream::kTangent1][some_cell(content, 1)] = 2 * 40 + 1;
  StreamDecoder decoder;
  EXPECT_EQ(decoder.feed(encode_stream(content).bytes), DecodeStatus::done);
  const DetailState& details = decoder.details();
  for (int c = 0; c < bitstream::kChannelCount; ++c) {
    for (int level = 0; level < 5; ++level) {
      EXPECT_EQ(details.has_details(c, level), c == bitstream::kTangent1 && level == 1);
    }
    // The children of a detail and its siblings in the other channels have a state.
    EXPECT_EQ(details.active_levels(c), c == bitstream::kTangent1 ? 3 : 2);
  }
  EXPECT_EQ(decoder.detailed_levels(), 2);
  EXPECT_EQ(decoder.coefficients().channels, content.coefficients.channels);
}

TEST(StreamPieces, OfEverySizeGiveTheSameDetails) {
  for (const test::Shape& shape : test::base_shapes()) {
    const StreamContent content = content_of(shape, 3, 16);
    const std::vector<std::uint8_t> bytes = encode_stream(content).bytes;
    for (const std::size_t size : {1u, 2u, 3u, 4u, 5u, 7u, 16u, 33u, 100u}) {
      StreamDecoder pieces;
      for (std::size_t n = 0; n < bytes.size(); n += size) {
        // Its own memory: a decoder that looks at it after `feed` is caught.
        const std::size_t end = std::min(n + size, bytes.size());
        pieces.feed(std::vector<std::uint8_t>(bytes.begin() + n, bytes.begin() + end));
        if (n % (41 * size) != 0) continue;
        StreamDecoder whole;
        whole.feed(std::span(bytes).first(end));
        ASSERT_EQ(whole.coefficients().channels, pieces.coefficients().channels) << size;
        ASSERT_EQ(whole.bytes_consumed(), pieces.bytes_consumed());
      }
      EXPECT_EQ(pieces.status(), DecodeStatus::done);
      EXPECT_EQ(pieces.bytes_consumed(), bytes.size());
      EXPECT_EQ(pieces.coefficients().channels, content.coefficients.channels) << size;
    }
  }
}

/// The lowest level in which two states of the details differ.
int first_difference(const bitstream::CoefficientSet& a, const bitstream::CoefficientSet& b) {
  for (int level = 0; level < a.levels; ++level) {
    const std::size_t begin = bitstream::level_offset(a.base_edge_count, level);
    const std::size_t end = bitstream::level_offset(a.base_edge_count, level + 1);
    for (std::size_t c = 0; c < bitstream::kChannelCount; ++c) {
      if (!std::equal(a.channels[c].begin() + begin, a.channels[c].begin() + end,
                      b.channels[c].begin() + begin)) {
        return level;
      }
    }
  }
  return kNothing;
}

TEST(StreamChanges, AreToldByTheirLowestLevel) {
  const StreamContent content = content_of(test::base_shapes()[0], 3, 8);
  const std::vector<std::uint8_t> bytes = encode_stream(content).bytes;
  StreamDecoder decoder;
  std::array<bool, 5> seen{};  // by the answer, -1 .. 2, and for nothing
  bool was_ready = false;
  for (std::size_t n = 0; n < bytes.size(); ++n) {
    const bitstream::CoefficientSet details = decoder.coefficients();
    const std::vector<float> positions = decoder.base_positions();
    decoder.feed(std::span(bytes).subspan(n, 1));
    int expected = kNothing;
    if (was_ready) expected = first_difference(details, decoder.coefficients());
    if (decoder.base_ready() && (!was_ready || decoder.base_positions() != positions)) {
      expected = -1;
    }
    ASSERT_EQ(decoder.changed_from(), expected) << n;
    was_ready = decoder.base_ready();
    decoder.forget_changes();
    EXPECT_EQ(decoder.changed_from(), kNothing);
    seen[expected == kNothing ? 4 : static_cast<std::size_t>(expected + 1)] = true;
  }
  EXPECT_EQ(seen, (std::array<bool, 5>{true, true, true, true, true}));
}

}  // namespace
}  // namespace zerotree
