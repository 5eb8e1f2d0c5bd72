#include "gltf/accessor_values.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <string>

namespace zerotree::gltf {
namespace {

// glTF-Validator's; a normal of bytes can be off by as much.
constexpr double kUnitTolerance = 0.00674;
constexpr std::size_t kMostComponents = 16;

template <class Component>
double read(const std::uint8_t* bytes) {
  Component value;
  std::memcpy(&value, bytes, sizeof value);
  return static_cast<double>(value);
}

// Digits that tell apart all floats and all integers of accessors.
std::string number_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.10g", value);
  return text;
}

// Where component `index` of an element begins: columns of matrices at multiples of 4.
std::uint64_t component_offset(const LinkedAccessor& accessor, std::size_t index) {
  const bool is_padded = accessor.element_size != accessor.components * accessor.component_size;
  const std::size_t rows = accessor.type == "MAT2" ? 2 : 3;
  if (!is_padded) return index * accessor.component_size;
  const std::uint64_t column = (rows * accessor.component_size + 3) / 4 * 4;
  return index / rows * column + index % rows * accessor.component_size;
}

// Smallest and largest value of each component, and how many lie beyond the stated ones.
struct Extent {
  std::array<double, kMostComponents> low{}, high{};
  std::array<std::uint64_t, kMostComponents> below{}, above{};
};

// `sign` is 1 for min, -1 for max.
void compare(const std::vector<double>& stated, const Extent& extent, bool is_min,
             const std::string& pointer, Issues& issues) {
  for (std::size_t k = 0; k < stated.size(); ++k) {
    const double actual = is_min ? extent.low[k] : extent.high[k];
    if (actual == stated[k]) continue;
    const std::string place = pointer + (is_min ? "/min/" : "/max/") + std::to_string(k);
    issues.push_back({is_min ? IssueCode::accessor_min_mismatch : IssueCode::accessor_max_mismatch,
                      place, number_text(stated[k]) + " instead of " + number_text(actual)});
    const std::uint64_t beyond = is_min ? extent.below[k] : extent.above[k];
    if (beyond > 0)
      issues.push_back({is_min ? IssueCode::accessor_element_out_of_min_bound
                               : IssueCode::accessor_element_out_of_max_bound,
                        place, std::to_string(beyond) + " of them"});
  }
}

}  // namespace

std::uint64_t component_size(std::uint64_t component_type) {
  switch (component_type) {
    case 5120:
    case 5121:
      return 1;
    case 5122:
    case 5123:
      return 2;
    case 5125:
    case kFloatType:
      return 4;
    default:
      return 0;
  }
}

double read_component(const std::uint8_t* bytes, std::uint64_t type) {
  switch (type) {
    case 5120:
      return read<std::int8_t>(bytes);
    case 5121:
      return read<std::uint8_t>(bytes);
    case 5122:
      return read<std::int16_t>(bytes);
    case 5123:
      return read<std::uint16_t>(bytes);
    case 5125:
      return read<std::uint32_t>(bytes);
    default:
      return read<float>(bytes);
  }
}

std::pair<double, double> component_range(std::uint64_t component_type) {
  const double bits = 8.0 * static_cast<double>(component_size(component_type));
  if (component_type == 5120 || component_type == 5122)
    return {-std::exp2(bits - 1), std::exp2(bits - 1) - 1};
  return {0, std::exp2(bits) - 1};
}

AccessorValues check_values(std::span<const std::uint8_t> bytes, std::uint64_t stride,
                            const LinkedAccessor& accessor, const JsonCursor& place,
                            Issues& issues) {
  AccessorValues values;
  Extent extent;
  std::optional<std::uint64_t> not_finite;
  const double scale = accessor.is_normalized ? component_range(accessor.component_type).second : 1;
  for (std::uint64_t i = 0; i < accessor.count; ++i) {
    double squares = 0;
    for (std::size_t k = 0; k < accessor.components; ++k) {
      const double value = read_component(bytes.data() + i * stride + component_offset(accessor, k),
                                          accessor.component_type);
      if (!std::isfinite(value) && !not_finite) not_finite = i;
      if (i == 0 || value < extent.low[k]) extent.low[k] = value;
      if (i == 0 || value > extent.high[k]) extent.high[k] = value;
      if (!accessor.min.empty() && value < accessor.min[k]) ++extent.below[k];
      if (!accessor.max.empty() && value > accessor.max[k]) ++extent.above[k];
      if (k == 0 && (i == 0 || value > values.largest)) {
        values.largest = value;
        values.largest_at = i;
      }
      const double unit = std::max(value / scale, -1.0);
      squares += accessor.is_normalized ? unit * unit : value * value;
    }
    if (std::abs(std::sqrt(squares) - 1) > kUnitTolerance && !values.non_unit) values.non_unit = i;
  }
  if (not_finite)
    issues.push_back({IssueCode::accessor_invalid_float, place.pointer(),
                      "element " + std::to_string(*not_finite)});
  compare(accessor.min, extent, true, place.pointer(), issues);
  compare(accessor.max, extent, false, place.pointer(), issues);
  return values;
}

}  // namespace zerotree::gltf
