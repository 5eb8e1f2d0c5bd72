// Bytes and time against what theory and the machine allow.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <map>

#include "random_content.h"

namespace zerotree {
namespace {

// Zeroth-order entropy of the coefficients, each level and channel with its own distribution.
double entropy_bytes(const encode::StreamContent& content) {
  const bitstream::CoefficientSet& set = content.coefficients;
  double bits = 0.0;
  for (const auto& channel : set.channels) {
    for (int level = 0; level < set.levels; ++level) {
      std::map<std::int32_t, double> count;
      const std::size_t begin = bitstream::level_offset(set.base_edge_count, level);
      const std::size_t end = bitstream::level_offset(set.base_edge_count, level + 1);
      for (std::size_t i = begin; i < end; ++i) count[channel[i]] += 1.0;
      for (const auto& [value, n] : count)
        bits -= n * std::log2(n / static_cast<double>(end - begin));
    }
  }
  return bits / 8.0;
}

encode::StreamContent laplacian(int levels, double finest_mean, double growth) {
  test::Shape base{"sphere", test::sphere(1), {}, {}};
  encode::StreamContent content = test::empty_content(test::canonical_base(base), levels, false, 1);
  test::add_laplacian_details(content, finest_mean, growth, 2);
  return content;
}

// Independent coefficients leave the contexts nothing to find but the levels' variances, so the
// coder must come close to the entropy of each level on its own.
TEST(StreamRate, IsCloseToTheEntropyOfIndependentDetails) {
  for (const double mean : {0.05, 0.3, 2.0, 20.0}) {
    const encode::StreamContent content = laplacian(5, mean, 2.0);
    const auto bytes = static_cast<double>(encode_stream(content).bytes.size());
    const double entropy = entropy_bytes(content);
    RecordProperty("mean_" + std::to_string(mean), std::to_string(bytes / entropy));
    EXPECT_LT(bytes, entropy * 1.08 + 100.0) << mean;
    EXPECT_GT(bytes, entropy * 0.97) << mean;
  }
}

TEST(StreamRate, NothingCostsNearlyNothing) {
  const encode::StreamContent content = laplacian(5, 0.0, 1.0);
  EXPECT_LE(encode_stream(content).bytes.size(), 14u);
  encode::StreamContent one = content;
  one.coefficients.channels[bitstream::kNormal][12345] = 3;
  EXPECT_LE(encode_stream(one).bytes.size(), 38u);
}

TEST(StreamRate, DecodesMillionsOfCoefficientsASecond) {
  const encode::StreamContent content = laplacian(6, 0.3, 2.0);
  const std::vector<std::uint8_t> bytes = encode_stream(content).bytes;
  bitstream::StreamDecoder decoder = test::decoder_for(content);
  const auto begin = std::chrono::steady_clock::now();
  decoder.feed(bytes);
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - begin;
  const std::size_t cells = content.coefficients.channels[0].size() * 3;
  ASSERT_EQ(decoder.status(), bitstream::DecodeStatus::done);
  std::printf("%zu coefficients, %zu bytes, %.1f ms\n", cells, bytes.size(), 1e3 * time.count());
  // Far below what a release build does, so that a loaded machine and sanitizers pass.
  EXPECT_LT(time.count(), 1e-6 * static_cast<double>(cells) * 10);
}

}  // namespace
}  // namespace zerotree
