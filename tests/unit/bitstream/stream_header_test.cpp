#include "bitstream/stream_header.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <stdexcept>

#include "encode/header_writer.h"

namespace zerotree::bitstream {
namespace {

StreamHeader embedded() {
  StreamHeader header;
  header.levels = 5;
  header.vertex_count = 112;
  header.face_count = 220;
  header.planes = 14;
  header.finest_step = encode::storable_step(1.5e-4);
  header.tangent_ratio_log2 = 3;
  header.positions = {{-8, 25, 6}, encode::storable_scale(header.finest_step, 0.001), 13, 4};
  return header;
}

StreamHeader external() {
  StreamHeader header = embedded();
  header.external_base = true;
  header.has_sharp_tags = true;
  header.positions = {};
  header.vertex_count = header.face_count = 0;  // not in the stream
  header.base_hash = 0x89abcdefu;
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
    EXPECT_EQ(back.has_sharp_tags, header.has_sharp_tags);
    EXPECT_EQ(back.levels, header.levels);
    EXPECT_EQ(back.planes, header.planes);
    EXPECT_EQ(back.tangent_ratio_log2, header.tangent_ratio_log2);
    EXPECT_EQ(back.vertex_count, header.vertex_count);
    EXPECT_EQ(back.face_count, header.face_count);
    EXPECT_EQ(back.positions.origin, header.positions.origin);
    if (!header.external_base) {
      EXPECT_EQ(back.positions.scale, header.positions.scale);
    }
    EXPECT_EQ(back.positions.bits, header.positions.bits);
    EXPECT_EQ(back.positions.initial_planes, header.positions.initial_planes);
  }
}

TEST(StreamHeader, IsSmall) {
  EXPECT_EQ(encode::write_header(embedded()).size(), 14u);
  EXPECT_EQ(encode::write_header(external()).size(), 11u);
}

TEST(StreamHeader, HoldsModelsFarFromTheOriginAndAnyTopology) {
  StreamHeader header = embedded();
  header.transform = 3;
  header.positions.origin = {std::numeric_limits<std::int32_t>::max(),
                             std::numeric_limits<std::int32_t>::min(), 16000000};
  header.levels = 0;
  header.planes = 0;
  for (const std::uint32_t faces : {38u, 112u, 220u, 224u, 5000u, 0x3fffffffu}) {
    header.face_count = faces;
    StreamHeader back;
    const HeaderResult result = read_header(
        encode::write_header(header),
        {.max_vertices = std::uint64_t{1} << 40, .max_memory = std::uint64_t{1} << 50}, back);
    ASSERT_EQ(result.status, DecodeStatus::done) << result.reason;
    EXPECT_EQ(back.face_count, faces);
    EXPECT_EQ(back.transform, 3u);
    EXPECT_EQ(back.positions.origin, header.positions.origin);
  }
}

TEST(StreamHeader, StepsAndScalesAreRoundedDownALittle) {
  for (const double step : {1e-9, 1.5e-4, 1.0, 3e7}) {
    const float stored = encode::storable_step(step);
    EXPECT_LE(double{stored}, step);
    EXPECT_GE(double{stored}, step * (1.0 - 0x1p-7) * (1.0 - 1e-6));
    const float scale = encode::storable_scale(stored, step / 33.0);
    EXPECT_LE(double{scale}, step / 33.0);
    EXPECT_GE(double{scale}, step / 33.0 * 0.8);
  }
  EXPECT_EQ(encode::storable_step(0.0), 0.0f);
  EXPECT_EQ(encode::storable_step(std::numeric_limits<double>::quiet_NaN()), 0.0f);
  StreamHeader header = embedded();
  header.finest_step = 0.1f;
  EXPECT_THROW(encode::write_header(header), std::invalid_argument);
  header = embedded();
  header.positions.scale *= 1.1f;
  EXPECT_THROW(encode::write_header(header), std::invalid_argument);
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
  EXPECT_TRUE(broken_after([](StreamHeader& h) { h.positions.bits = 29; }));
  EXPECT_TRUE(broken_after([](StreamHeader& h) { h.positions.bits = 0; }));
  EXPECT_TRUE(broken_after([](StreamHeader& h) { h.positions.initial_planes = 14; }));
  EXPECT_TRUE(broken_after([](StreamHeader& h) {
    h.finest_step = 0x1p100f;
    h.positions.scale = encode::storable_scale(h.finest_step, 0x1p101);
    h.positions.origin[1] = 0x7fffffff;
  }));
  EXPECT_FALSE(broken_after([](StreamHeader&) {}));
}

TEST(StreamHeader, RefusesFieldsThatNoWriterWrites) {
  const std::vector<std::uint8_t> good = encode::write_header(embedded());
  const auto broken_with = [&](std::size_t place, std::vector<std::uint8_t> replaced) {
    std::vector<std::uint8_t> bytes = good;
    std::copy(replaced.begin(), replaced.end(), bytes.begin() + static_cast<std::ptrdiff_t>(place));
    StreamHeader back;
    return read_header(bytes, {}, back).status == DecodeStatus::broken;
  };
  EXPECT_FALSE(broken_with(0, {}));
  EXPECT_TRUE(broken_with(6, {0x00, 0x00}));                    // no step
  EXPECT_TRUE(broken_with(6, {0xc0, 0x7f}));                    // not a number
  EXPECT_TRUE(broken_with(6, {0x80, 0x7f}));                    // infinite
  EXPECT_TRUE(broken_with(6, {0x19, 0xb9}));                    // negative
  EXPECT_TRUE(broken_with(6, {0x7f, 0x7f, 255}));               // scale beyond the floats
  EXPECT_TRUE(broken_with(6, {0x80, 0x00, 0}));                 // scale below them
  EXPECT_TRUE(broken_with(9, {0xff, 0xff, 0xff, 0xff, 0x7f}));  // origin beyond 32 bits
}

TEST(StreamHeader, RefusesForeignBytesAtOnce) {
  StreamHeader header;
  const auto status = [&](std::vector<std::uint8_t> bytes) {
    return read_header(bytes, {}, header).status;
  };
  EXPECT_EQ(status({'g'}), DecodeStatus::broken);
  EXPECT_EQ(status({'Z', 'X'}), DecodeStatus::broken);
  EXPECT_EQ(status({'Z', 'T', 2}), DecodeStatus::broken);
  EXPECT_EQ(status({'Z', 'T', 0}), DecodeStatus::broken);
  EXPECT_EQ(status({'Z', 'T', 1, 15}), DecodeStatus::broken);
  // An external base has no planes of positions.
  EXPECT_EQ(status({'Z', 'T', 0x11, 5, 0x2e}), DecodeStatus::broken);
  // A number in more bytes than it needs, and one of more than five.
  std::vector<std::uint8_t> bytes = encode::write_header(embedded());
  bytes.resize(9);
  std::vector<std::uint8_t> padded = bytes, endless = bytes;
  padded.insert(padded.end(), {0x80, 0x00});
  endless.insert(endless.end(), {0xff, 0xff, 0xff, 0xff, 0xff});
  EXPECT_EQ(status(bytes), DecodeStatus::more_bytes_wanted);
  EXPECT_EQ(status(padded), DecodeStatus::broken);
  EXPECT_EQ(status(endless), DecodeStatus::broken);
}

TEST(StreamHeader, HoldsTheReadersLimits) {
  EXPECT_EQ(read(embedded(), {.max_levels = 4}).status, DecodeStatus::broken);
  EXPECT_EQ(read(embedded(), {.max_levels = 5}).status, DecodeStatus::done);
  const std::uint64_t vertices = 112 + 330 * 341;
  EXPECT_EQ(read(embedded(), {.max_vertices = vertices - 1}).status, DecodeStatus::broken);
  EXPECT_EQ(read(embedded(), {.max_vertices = vertices}).status, DecodeStatus::done);
  EXPECT_EQ(read(embedded(), {.max_memory = 1000000}).status, DecodeStatus::broken);
  // The counts of an external base come with the base.
  EXPECT_EQ(read(external(), {.max_vertices = 10}).status, DecodeStatus::done);
  EXPECT_EQ(read(external(), {.max_levels = 4}).status, DecodeStatus::broken);
}

TEST(StreamHeader, AnyBytesAreSafe) {
  std::mt19937 random(4);
  for (int round = 0; round < 20000; ++round) {
    std::vector<std::uint8_t> bytes = encode::write_header(round % 2 ? embedded() : external());
    for (int flips = 0; flips < 3; ++flips) {
      bytes[2 + random() % (bytes.size() - 2)] = static_cast<std::uint8_t>(random());
    }
    StreamHeader header;
    const HeaderResult result = read_header(bytes, {}, header);
    EXPECT_EQ(result.status == DecodeStatus::broken, !result.reason.empty());
  }
}

}  // namespace
}  // namespace zerotree::bitstream
