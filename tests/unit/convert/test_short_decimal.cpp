#include "convert/short_decimal.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace zerotree::convert {
namespace {

TEST(RoundedUp, KeepsFewDigits) {
  EXPECT_EQ(rounded_up(0.00011756484, 3), 0.000118);
  EXPECT_EQ(rounded_up(7.509738e-05, 3), 7.51e-05);
  EXPECT_EQ(rounded_up(40.61, 3), 40.7);
  EXPECT_EQ(rounded_up(123456, 3), 124000);
  EXPECT_EQ(rounded_up(9.999, 3), 10);
}

TEST(RoundedUp, LeavesShortNumbers) {
  for (double value : {0.1, 0.3, 2.5, 7.51e-05, 1000.0, 1e-9})
    EXPECT_EQ(rounded_up(value, 3), value);
}

TEST(RoundedUp, IsNeverBelowAndClose) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> exponent(-12, 12);
  for (int i = 0; i < 10000; ++i) {
    const double value = std::pow(10.0, exponent(random));
    const double rounded = rounded_up(value, 3);
    EXPECT_GE(rounded, value);
    EXPECT_LE(rounded, value * 1.0101);
  }
}

TEST(RoundedByStep, GoesToItsSide) {
  EXPECT_EQ(rounded_down(-0.0434168, 0.0005), -0.0435);
  EXPECT_EQ(rounded_up_by_step(0.0433844, 0.0005), 0.0434);
  EXPECT_EQ(rounded_down(3341.7, 171), 3300);
  EXPECT_EQ(rounded_up_by_step(30444.2, 171), 30500);
}

TEST(RoundedByStep, IsNeverBeyondAndClose) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> value_of(-50, 50), exponent(-6, 3);
  for (int i = 0; i < 10000; ++i) {
    const double value = value_of(random), step = std::pow(10.0, exponent(random));
    EXPECT_LE(rounded_down(value, step), value);
    EXPECT_GT(rounded_down(value, step), value - step);
    EXPECT_GE(rounded_up_by_step(value, step), value);
    EXPECT_LT(rounded_up_by_step(value, step), value + step);
  }
}

TEST(RoundedByStep, LeavesWhatItCannotCount) {
  EXPECT_EQ(rounded_down(1e30, 1e-3), 1e30);
}

}  // namespace
}  // namespace zerotree::convert
