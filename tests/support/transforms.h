// The wavelet transforms that a stream may name, for tests that hold for each of them.
#pragma once

#include <array>
#include <string>

#include "surface/wavelet_transform.h"

namespace zerotree::test {

inline constexpr auto kQuadratureMirror = surface::WaveletTransform::loop_quadrature_mirror;
inline constexpr auto kLocal = surface::WaveletTransform::loop_local;
inline constexpr std::array kTransforms = {kQuadratureMirror, kLocal};

inline std::string name_of(surface::WaveletTransform transform) {
  return transform == kLocal ? "local" : "quadrature_mirror";
}

}  // namespace zerotree::test
