// The values of an accessor, compared with what it says about them.
#pragma once

#include <cstdint>
#include <span>
#include <utility>

#include "gltf/accessor_check.h"

namespace zerotree::gltf {

inline constexpr std::uint64_t kFloatType = 5126;

/// Bytes of a component of `component_type`; 0 if glTF has no such type.
std::uint64_t component_size(std::uint64_t component_type);
/// The value at `bytes` of a component of `component_type`, one of glTF's.
double read_component(const std::uint8_t* bytes, std::uint64_t component_type);
/// Smallest and largest value of an integer type.
std::pair<double, double> component_range(std::uint64_t component_type);

/// Looks at all elements of `accessor`, at multiples of `stride` in `bytes`, which must hold them:
/// adds to `issues`, at `place`, values that are not finite or beyond min and max.
AccessorValues check_values(std::span<const std::uint8_t> bytes, std::uint64_t stride,
                            const LinkedAccessor& accessor, const JsonCursor& place,
                            Issues& issues);

}  // namespace zerotree::gltf
