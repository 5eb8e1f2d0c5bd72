#include "bitstream/cell_blocks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "bitstream/level_values.h"

namespace zerotree::bitstream {
namespace {

using Block = std::uint8_t[kBlockCells];

// Bytes near the values where the loops decide.
void fill(std::uint8_t* bytes, std::size_t count, std::mt19937& random) {
  constexpr std::uint8_t kEdges[] = {0, 1, 3, 4, 20, 21, 63, 64, 127, 128, 254, 255};
  for (std::size_t i = 0; i < count; ++i) bytes[i] = kEdges[random() % std::size(kEdges)];
}

TEST(CellBlocks, MasksAreTheSameOnEveryMachine) {
  std::mt19937 random(1);
  for (int round = 0; round < 100; ++round) {
    Block bytes;
    const BlockMask expected = BlockMask{random()} << 32 | random();
    for (std::size_t i = 0; i < kBlockCells; ++i) bytes[i] = (expected >> i) & 1 ? 255 : 0;
    EXPECT_EQ(gathered_mask(bytes), expected);
    EXPECT_EQ(mask_of(bytes), expected);
  }
}

TEST(CellBlocks, LikelyCellsAreThoseWithActivityAndNoFlag) {
  std::mt19937 random(2);
  for (int round = 0; round < 100; ++round) {
    Block flags, around, above;
    fill(around, kBlockCells, random);
    fill(above, kBlockCells, random);
    for (std::uint8_t& f : flags) f = static_cast<std::uint8_t>(random() % 3);
    for (const std::uint8_t activity : {std::uint8_t{4}, std::uint8_t{21}}) {
      const BlockMask likely = likely_cells(flags, around, above, activity);
      for (std::size_t i = 0; i < kBlockCells; ++i) {
        EXPECT_EQ((likely >> i) & 1, flags[i] == 0 && around[i] + above[i] >= activity);
      }
    }
    const BlockMask refinable = refinable_cells(flags);
    for (std::size_t i = 0; i < kBlockCells; ++i) {
      EXPECT_EQ((refinable >> i) & 1, flags[i] == kSignificant);
    }
  }
}

TEST(CellBlocks, SumsDoubleUpToTheirLimits) {
  for (int begin = 0; begin < 256; begin += static_cast<int>(kBlockCells)) {
    Block sums;
    std::int8_t leans[kBlockCells];
    for (std::size_t i = 0; i < kBlockCells; ++i) {
      sums[i] = static_cast<std::uint8_t>(begin + static_cast<int>(i));
      leans[i] = static_cast<std::int8_t>(std::max(-127, begin + static_cast<int>(i) - 128));
    }
    double_sums(sums);
    double_leans(leans);
    for (std::size_t i = 0; i < kBlockCells; ++i) {
      const int value = begin + static_cast<int>(i);
      EXPECT_EQ(sums[i], std::min(255, 2 * value));
      EXPECT_EQ(leans[i], std::clamp(2 * std::max(-127, value - 128), -127, 127));
    }
  }
}

TEST(CellBlocks, ACellClosesWhenItIsCodedAndAllItsChildrenAreClosed) {
  std::mt19937 random(3);
  for (const std::uint8_t closed :
       {std::uint8_t{kClosed | kAbsent}, std::uint8_t{kSignificant | kVisited | kAbsent}}) {
    for (const std::size_t count : {kBlockCells, std::size_t{5}}) {
      Block flags, before;
      // No more than are looked at.
      std::vector<std::uint8_t> children(4 * count);
      for (std::uint8_t& f : before) f = static_cast<std::uint8_t>(random() % 3);
      for (std::uint8_t& f : children) {
        f = static_cast<std::uint8_t>(random() % 8 == 0 ? 0 : 1 << (random() % 4));
      }
      std::copy(std::begin(before), std::end(before), flags);
      close_cells(flags, children.data(), count, closed);
      for (std::size_t i = 0; i < kBlockCells; ++i) {
        bool closes = i < count && before[i] != 0;
        for (std::size_t k = 0; closes && k < 4; ++k) closes = (children[4 * i + k] & closed) != 0;
        EXPECT_EQ(flags[i], before[i] | (closes ? kClosed : 0));
      }
    }
  }
}

TEST(LevelValues, KeepTheirValuesWhenWidened) {
  LevelValues values(5, false, std::pmr::new_delete_resource());
  values.clear();
  EXPECT_EQ(values.get(3), 0);
  values.set(1, 32767);
  values.set(4, -32767);
  EXPECT_FALSE(values.is_wide());
  EXPECT_EQ(values.narrow()[1], 32767);
  values.widen();
  EXPECT_TRUE(values.is_wide());
  values.set(0, -(3 << 14));
  for (const auto& [cell, value] : {std::pair{0, -(3 << 14)}, {1, 32767}, {2, 0}, {4, -32767}}) {
    EXPECT_EQ(values.get(static_cast<std::size_t>(cell)), value);
    EXPECT_EQ(values.wide()[cell], value);
  }
}

}  // namespace
}  // namespace zerotree::bitstream
