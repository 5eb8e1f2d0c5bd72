#include "bitstream/stream_header.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "encode/header_writer.h"

namespace zerotree::bitstream {
namespace {

StreamHeader embedded() {
  StreamHeader header;
  header.levels = 5;
  header.vertex_count = 112;
  header.face_count = 220;
  header.planes = 14;
  header.finest_step = 1.5e-4f;
  header.tangent_ratio_log2 = 3;
  header.positions = {{-1.0f, 2.0f, 0.5f}, 0.001f, 13, 4};
  header.connectivity_bytes = 60;
  return header;
}

StreamHeader external() {
  StreamHeader header = embedded();
  header.external_base = true;
  header.has_sharp_tags = true;
  header.positions = {};
  header.connectivity_bytes = 0;
  header.base_hash = 0x0123456789abcdefu;
  return header;
}

HeaderResult read(const StreamHeader& header, const Limits& limits = {}) {
  StreamHeader back;
  return read_header(encode::write_header(header), limits, back);
}

TEST(StreamHeader, RoundTrips) {
  for (const StreamHeader& header : {embedded(), external()}) {
    std::vector<std::uint8_t> bytes = encode::write_header(header);
    const std::size_t size = bytes.size();
    bytes.push_back(0xff);
    StreamHeader back;
    const HeaderResult result = read_header(bytes, {}, back);
    ASSERT_EQ(result.status, DecodeStatus::done) << result.reason;
    EXPECT_EQ(result.size, size);
    EXPECT_EQ(encode::write_header(back), encode::write_header(header));
    EXPECT_EQ(back.base_hash, header.base_hash);
    EXPECT_EQ(back.finest_step, header.finest_step);
    EXPECT_EQ(back.positions.bits, header.positions.bits);
  }
}

TEST(StreamHeader, IsSmall) {
  EXPECT_EQ(encode::write_header(embedded()).size(), 34u);
  EXPECT_EQ(encode::write_header(external()).size(), 23u);
}

TEST(StreamHeader, PrefixesWantMore) {
  for (const StreamHeader& header : {embedded(), external()}) {
    const std::vector<std::uint8_t> bytes = encode::write_header(header);
    for (std::size_t n = 0; n < bytes.size(); ++n) {
      const std::vector<std::uint8_t> prefix(bytes.begin(), bytes.begin() + n);
      StreamHeader back;
      EXPECT_EQ(read_header(prefix, {}, back).status, DecodeStatus::more_bytes_wanted) << n;
    }
  }
}

TEST(StreamHeader, RefusesEveryFieldOutOfRange) {
  const auto broken_after = [](auto change) {
    StreamHeader header = embedded();
    change(header);
    return read(header).status == DecodeStatus::broken;
  };
  EXPECT_TRUE(broken_after([](StreamHeader& h) { h.levels = 15; }));
  EXPECT_TRUE(broken_after([](StreamHeader& h) { h.levels = 0; }));
  EXPECT_TRUE(broken_after([](StreamHeader& h) { h.vertex_count = 2; }));
  EXPECT_TRUE(broken_after([](StreamHeader& h) { h.vertex_count = 661; }));
  EXPECT_TRUE(broken_after([](StreamHeader& h) { h.face_count = 0; }));
  EXPECT_TRUE(broken_after([](StreamHeader& h) { h.face_count = 0xffffffffu; }));
  EXPECT_TRUE(broken_after([](StreamHeader& h) { h.planes = 31; }));
  EXPECT_TRUE(broken_after([](StreamHeader& h) { h.finest_step = 0.0f; }));
  EXPECT_TRUE(broken_after(
      [](StreamHeader& h) { h.finest_step = std::numeric_limits<float>::quiet_NaN(); }));
  EXPECT_TRUE(broken_after([](StreamHeader& h) { h.tangent_ratio_log2 = 16; }));
  EXPECT_TRUE(broken_after(
      [](StreamHeader& h) { h.positions.origin[1] = std::numeric_limits<float>::infinity(); }));
  EXPECT_TRUE(broken_after([](StreamHeader& h) { h.positions.scale = -1.0f; }));
  EXPECT_TRUE(broken_after([](StreamHeader& h) { h.positions.bits = 29; }));
  EXPECT_TRUE(broken_after([](StreamHeader& h) { h.positions.bits = 0; }));
  EXPECT_TRUE(broken_after([](StreamHeader& h) { h.positions.initial_planes = 14; }));
  EXPECT_TRUE(broken_after([](StreamHeader& h) { h.connectivity_bytes = 0; }));
  EXPECT_FALSE(broken_after([](StreamHeader&) {}));
}

TEST(StreamHeader, RefusesForeignBytesAtOnce) {
  StreamHeader header;
  const auto status = [&](std::vector<std::uint8_t> bytes) {
    return read_header(bytes, {}, header).status;
  };
  EXPECT_EQ(status({'g'}), DecodeStatus::broken);
  EXPECT_EQ(status({'Z', 'X'}), DecodeStatus::broken);
  EXPECT_EQ(status({'Z', 'T', 2, 0}), DecodeStatus::broken);
  EXPECT_EQ(status({'Z', 'T', 1, 4}), DecodeStatus::broken);
  // A number in more bytes than it needs, and one of more than 32 bits.
  EXPECT_EQ(status({'Z', 'T', 1, 0, 0x80, 0x00}), DecodeStatus::broken);
  EXPECT_EQ(status({'Z', 'T', 1, 0, 0xff, 0xff, 0xff, 0xff, 0x7f}), DecodeStatus::broken);
}

TEST(StreamHeader, HoldsTheReadersLimits) {
  EXPECT_EQ(read(embedded(), {.max_levels = 4}).status, DecodeStatus::broken);
  EXPECT_EQ(read(embedded(), {.max_levels = 5}).status, DecodeStatus::done);
  const std::uint64_t vertices = 112 + 330 * 341;
  EXPECT_EQ(read(embedded(), {.max_vertices = vertices - 1}).status, DecodeStatus::broken);
  EXPECT_EQ(read(embedded(), {.max_vertices = vertices}).status, DecodeStatus::done);
  EXPECT_EQ(read(embedded(), {.max_memory = 1000000}).status, DecodeStatus::broken);
}

TEST(StreamHeader, AnyBytesAreSafe) {
  std::mt19937 random(4);
  for (int round = 0; round < 20000; ++round) {
    std::vector<std::uint8_t> bytes = encode::write_header(round % 2 ? embedded() : external());
    for (int flips = 0; flips < 3; ++flips) {
      bytes[4 + random() % (bytes.size() - 4)] = static_cast<std::uint8_t>(random());
    }
    StreamHeader header;
    const HeaderResult result = read_header(bytes, {}, header);
    EXPECT_EQ(result.status == DecodeStatus::broken, !result.reason.empty());
  }
}

}  // namespace
}  // namespace zerotree::bitstream
