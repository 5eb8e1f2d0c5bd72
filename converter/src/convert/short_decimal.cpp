#include "convert/short_decimal.h"

#include <charconv>
#include <cmath>
#include <string>

namespace zerotree::convert {
namespace {

// count * 10^exponent as a reader of the decimal digits gets it: powers of ten below one are not
// exact, so the product would be a neighbour of many more digits.
double decimal(double count, int exponent) {
  const std::string text =
      std::to_string(static_cast<long long>(count)) + "e" + std::to_string(exponent);
  double value = 0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

int decimal_exponent(double value) {
  return static_cast<int>(std::floor(std::log10(value)));
}

// How often 10^exponent fits `value`. Huge ratios are no shorter when rounded.
double count_of(double value, int exponent) {
  return exponent < 0 ? value * std::pow(10.0, -exponent) : value / std::pow(10.0, exponent);
}

constexpr double kMostExact = 9e15;

}  // namespace

double rounded_up(double value, int digits) {
  const int exponent = decimal_exponent(value) - digits + 1;
  double count = std::floor(count_of(value, exponent));
  while (decimal(count, exponent) < value) ++count;
  return decimal(count, exponent);
}

double rounded_down(double value, double step) {
  const int exponent = decimal_exponent(step);
  double count = std::ceil(count_of(value, exponent));
  if (!(std::abs(count) < kMostExact)) return value;
  while (decimal(count, exponent) > value) --count;
  return decimal(count, exponent);
}

double rounded_up_by_step(double value, double step) {
  return -rounded_down(-value, step);
}

}  // namespace zerotree::convert
