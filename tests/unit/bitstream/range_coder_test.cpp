#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <vector>

#include "bitstream/range_decoder.h"
#include "encode/range_encoder.h"

namespace zerotree {
namespace {

using bitstream::AdaptiveBit;
using bitstream::RangeDecoder;
using encode::RangeEncoder;

constexpr int kContexts = 20;

// A decision: its context (kContexts means equiprobable) and the bit.
struct Decision {
  int context;
  bool bit;
};

std::vector<Decision> random_decisions(std::size_t count, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::vector<Decision> decisions(count);
  for (Decision& d : decisions) {
    d.context = static_cast<int>(random() % (kContexts + 1));
    // Context c yields ones with probability (c / 20)^3: from never to always.
    const double share = d.context / double{kContexts};
    d.bit = d.context == kContexts
                ? (random() & 1) != 0
                : static_cast<double>(random()) < share * share * share * 4294967296.0;
  }
  return decisions;
}

struct Encoded {
  std::vector<std::uint8_t> bytes;
  std::vector<std::size_t> sufficient;
};

Encoded encode_decisions(const std::vector<Decision>& decisions) {
  RangeEncoder coder;
  std::array<AdaptiveBit, kContexts> contexts;
  Encoded result;
  for (const Decision& d : decisions) {
    d.context == kContexts ? coder.code_raw(d.bit) : coder.code(d.bit, contexts[d.context]);
    result.sufficient.push_back(coder.sufficient_bytes());
  }
  result.bytes = coder.finish();
  return result;
}

class Reader {
 public:
  // Decodes on with more bytes, those given before included; false if a decision comes out wrong.
  bool read(std::span<const std::uint8_t> bytes, const std::vector<Decision>& truth) {
    coder.add_bytes(bytes.subspan(given));
    given = bytes.size();
    for (; count < truth.size(); ++count) {
      const Decision& d = truth[count];
      const bool bit =
          d.context == kContexts ? coder.code_raw(false) : coder.code(false, contexts[d.context]);
      if (coder.starved()) return true;
      if (bit != d.bit) return false;
    }
    return true;
  }
  RangeDecoder coder;
  std::size_t count = 0;
  std::size_t given = 0;

 private:
  std::array<AdaptiveBit, kContexts> contexts;
};

TEST(RangeCoder, RoundTripsAndKnowsItsLength) {
  for (std::uint32_t seed = 0; seed < 200; ++seed) {
    const auto decisions = random_decisions(seed * 7, seed);
    const Encoded encoded = encode_decisions(decisions);
    Reader reader;
    ASSERT_TRUE(reader.read(encoded.bytes, decisions)) << seed;
    EXPECT_EQ(reader.count, decisions.size()) << seed;
    EXPECT_EQ(reader.coder.sequence_length(), encoded.bytes.size()) << seed;
  }
}

TEST(RangeCoder, AnyContinuationDecodesTheSame) {
  const auto decisions = random_decisions(3000, 5);
  for (const std::uint8_t filler : std::array<std::uint8_t, 3>{0x00, 0x7f, 0xff}) {
    Encoded encoded = encode_decisions(decisions);
    const std::size_t length = encoded.bytes.size();
    encoded.bytes.resize(length + 20, filler);
    Reader reader;
    ASSERT_TRUE(reader.read(encoded.bytes, decisions));
    EXPECT_EQ(reader.count, decisions.size());
    EXPECT_EQ(reader.coder.sequence_length(), length);
  }
}

TEST(RangeCoder, EveryPrefixYieldsATruePrefixOfTheDecisions) {
  const auto decisions = random_decisions(2000, 1);
  const Encoded encoded = encode_decisions(decisions);
  std::size_t previous = 0;
  for (std::size_t length = 0; length <= encoded.bytes.size(); ++length) {
    // Exactly sized, so that reading beyond is caught.
    const std::vector<std::uint8_t> prefix(encoded.bytes.begin(), encoded.bytes.begin() + length);
    Reader reader;
    ASSERT_TRUE(reader.read(prefix, decisions)) << length;
    EXPECT_GE(reader.count, previous);
    previous = reader.count;
    for (std::size_t i = reader.count; i < decisions.size(); ++i) {
      ASSERT_GT(encoded.sufficient[i], length) << "decision " << i;
    }
  }
  EXPECT_EQ(previous, decisions.size());
}

TEST(RangeCoder, PiecesDecodeAsTheWhole) {
  const auto decisions = random_decisions(2000, 2);
  const Encoded encoded = encode_decisions(decisions);
  Reader pieces;
  for (std::size_t length = 0; length <= encoded.bytes.size(); ++length) {
    const std::span prefix(encoded.bytes.data(), length);
    ASSERT_TRUE(pieces.read(prefix, decisions));
    Reader whole;
    ASSERT_TRUE(whole.read(prefix, decisions));
    ASSERT_EQ(pieces.count, whole.count) << length;
  }
  EXPECT_EQ(pieces.count, decisions.size());
}

// Bytes that no encoder writes, a register of ones among them, are safe and mean one thing.
TEST(RangeCoder, AnyBytesMeanTheSameInPieces) {
  std::mt19937 random(4);
  for (int round = 0; round < 200; ++round) {
    std::vector<std::uint8_t> bytes(60);
    for (std::uint8_t& b : bytes) b = static_cast<std::uint8_t>(random());
    std::fill_n(bytes.begin(), round % 6, std::uint8_t{0xff});
    const auto decode = [&](std::size_t piece) {
      RangeDecoder coder;
      std::array<AdaptiveBit, kContexts> contexts;
      std::vector<bool> bits;
      for (std::size_t begin = 0; begin < bytes.size(); begin += piece) {
        coder.add_bytes(std::span(bytes).subspan(begin, std::min(piece, bytes.size() - begin)));
        while (true) {
          const std::size_t n = bits.size();
          const bool bit = n % 3 == 0   ? coder.code(false, contexts[n % kContexts])
                           : n % 3 == 1 ? coder.code_even(false, contexts[n % 7])
                                        : coder.code_raw(false);
          if (coder.starved()) break;
          // All ones: every decision is zero.
          EXPECT_FALSE(bit && round % 6 >= 4);
          bits.push_back(bit);
          if (bits.size() > 2000) return bits;
        }
      }
      return bits;
    };
    const std::vector<bool> whole = decode(bytes.size());
    for (const std::size_t piece : {1u, 3u, 4u, 7u}) ASSERT_EQ(decode(piece), whole) << round;
  }
}

TEST(RangeCoder, CarriesRunThroughHeldBackBytes) {
  // Ones in a context that has learned zeros drive `low` up against carries.
  std::vector<Decision> decisions;
  std::mt19937 random(9);
  for (int i = 0; i < 200000; ++i) decisions.push_back({0, random() % 977 == 0});
  for (int i = 0; i < 20000; ++i) decisions.push_back({kContexts, false});
  const Encoded encoded = encode_decisions(decisions);
  Reader reader;
  ASSERT_TRUE(reader.read(encoded.bytes, decisions));
  EXPECT_EQ(reader.count, decisions.size());
}

TEST(RangeCoder, CostsWhatTheProbabilitiesSay) {
  std::mt19937 random(3);
  RangeEncoder coder;
  AdaptiveBit context;
  constexpr int kCount = 100000;
  for (int i = 0; i < kCount; ++i) coder.code(random() % 10 == 0, context);
  const double entropy = 0.469 * kCount / 8;  // of a bit that is set with probability 1/10
  const auto size = static_cast<double>(coder.finish().size());
  EXPECT_GT(size, entropy);
  EXPECT_LT(size, entropy * 1.02);
}

TEST(AdaptiveBit, NeverBecomesCertain) {
  for (const bool bit : {false, true}) {
    AdaptiveBit context;
    for (int i = 0; i < 100000; ++i) context.update(bit);
    const auto p = context.probability_of_one();
    EXPECT_TRUE(bit ? p > 65000 && p < 65536 : p < 536 && p > 0) << p;
  }
}

TEST(AdaptiveBit, LearnsFromItsFirstBits) {
  AdaptiveBit context;
  EXPECT_EQ(context.probability_of_one(), 32768u);
  for (int i = 0; i < 4; ++i) context.update(true);
  EXPECT_GT(context.probability_of_one(), 58000u);
}

}  // namespace
}  // namespace zerotree
