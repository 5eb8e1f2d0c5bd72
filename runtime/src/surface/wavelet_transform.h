// The wavelet transforms a stream can name.
#pragma once

#include <cstdint>

namespace zerotree::surface {

/// How details become displacements of the finer control points: fine = P coarse + Q details.
/// P is always Loop subdivision; the value is the one that the stream's header holds.
enum class WaveletTransform : std::uint8_t {
  /// The paper's quadrature mirror filter (section 3.3, figure 4).
  loop_quadrature_mirror = 0,
  /// Each detail moves its odd vertex and, the other way, the two even vertices beside it (see
  /// local_filter.h): nearly orthogonal, better conditioned, and analysed 30 times as fast.
  loop_local = 1,
};

/// True for the values a stream may name.
constexpr bool is_known_transform(std::uint32_t value) {
  return value <= static_cast<std::uint32_t>(WaveletTransform::loop_local);
}

}  // namespace zerotree::surface
