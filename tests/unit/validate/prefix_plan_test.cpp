#include "validate/prefix_plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace zerotree::validate {
namespace {

std::vector<std::uint8_t> payload_of(std::size_t size) {
  std::vector<std::uint8_t> payload(size);
  std::iota(payload.begin(), payload.end(), std::uint8_t{1});
  return payload;
}

std::vector<gltf::PrefixEntry> table_of(std::size_t entries, std::uint64_t size) {
  std::vector<gltf::PrefixEntry> table;
  for (std::size_t i = 1; i <= entries; ++i) table.push_back({size * i / entries, 1.0});
  return table;
}

std::vector<std::uint64_t> lengths(const PrefixPlan& plan) {
  std::vector<std::uint64_t> lengths;
  for (const Checkpoint& checkpoint : plan.checkpoints) lengths.push_back(checkpoint.bytes);
  return lengths;
}

TEST(PrefixPlan, HoldsNoneAllTheTableAndRandomOnes) {
  const auto payload = payload_of(100000);
  const PrefixPlan plan = plan_prefixes(payload, table_of(4, payload.size()), 8, 1000);
  const std::vector<std::uint64_t> planned = lengths(plan);
  EXPECT_TRUE(std::is_sorted(planned.begin(), planned.end()));
  EXPECT_EQ(std::adjacent_find(planned.begin(), planned.end()), planned.end());
  EXPECT_EQ(planned.front(), 0u);
  EXPECT_EQ(planned.back(), payload.size());
  EXPECT_EQ(plan.entries_left_out, 0u);
  EXPECT_GE(planned.size(), 10u);
  EXPECT_LE(planned.size(), 13u);
  std::size_t entries = 0;
  for (const Checkpoint& checkpoint : plan.checkpoints)
    if (checkpoint.entry) {
      EXPECT_EQ(*checkpoint.entry, entries++);
      EXPECT_EQ(checkpoint.bytes, payload.size() * entries / 4);
    }
  EXPECT_EQ(entries, 4u);
}

TEST(PrefixPlan, DependsOnTheBytesAlone) {
  auto payload = payload_of(5000);
  const std::vector<std::uint64_t> planned = lengths(plan_prefixes(payload, {}, 8, 1));
  EXPECT_EQ(lengths(plan_prefixes(payload, {}, 8, 1)), planned);
  payload[4000] ^= 1;
  EXPECT_NE(lengths(plan_prefixes(payload, {}, 8, 1)), planned);
}

TEST(PrefixPlan, TakesFewerOfLargeSurfaces) {
  const auto payload = payload_of(5000);
  const auto table = table_of(4, payload.size());
  EXPECT_EQ(plan_prefixes(payload, table, 100, kMostCost / 6).checkpoints.size(), 6u);
  EXPECT_EQ(plan_prefixes(payload, table, 100, kMostCost / 2).checkpoints.size(), 4u);
  const PrefixPlan sampled = plan_prefixes(payload, table, 100, kMostTableCost / 2);
  EXPECT_EQ(sampled.entries_left_out, 2u);
  EXPECT_EQ(lengths(sampled), (std::vector<std::uint64_t>{2500, 5000}));
  // One surface that is too large in itself is looked at once.
  const PrefixPlan one = plan_prefixes(payload, table, 100, 3 * kMostTableCost);
  EXPECT_EQ(lengths(one), std::vector<std::uint64_t>{5000});
  EXPECT_EQ(one.checkpoints[0].entry, 3u);
}

TEST(PrefixPlan, EndsWhereTheBytesEnd) {
  const auto payload = payload_of(50);
  const PrefixPlan plan = plan_prefixes(payload, table_of(4, 100), 0, 1);
  EXPECT_EQ(lengths(plan), (std::vector<std::uint64_t>{0, 25, 50}));
}

TEST(PrefixPlan, OfNoBytesIsNoByte) {
  EXPECT_EQ(lengths(plan_prefixes({}, {}, 8, 1)), std::vector<std::uint64_t>{0});
}

}  // namespace
}  // namespace zerotree::validate
