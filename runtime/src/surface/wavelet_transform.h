// The wavelet transforms a stream can name.
#pragma once

#include <cstdint>

namespace zerotree::surface {

/// How details become displacements of the finer control points: fine = P coarse + Q details.
/// P is always Loop subdivision; the value is the one that the stream's header holds.
enum class WaveletTransform : std::uint8_t {
  /// The paper's quadrature mirror filter (section 3.3, figure 4).
  loop_quadrature_mirror = 0,
};

}  // namespace zerotree::surface
