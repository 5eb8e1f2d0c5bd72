// Small progressive assets with real payloads.
#pragma once

#include <cstdint>
#include <vector>

#include "gltf/progressive_asset.h"
#include "shapes.h"

namespace zerotree::test {

/// `shape` with arbitrary small details on two levels, coded against its own base; all rules kept
/// unless `detail_scale` makes the details so large that the surface leaves the bounds.
gltf::ProgressiveAsset encoded_asset(const Shape& shape, double detail_scale = 1);

/// The same on a grid of 16-bit integers, which a node puts back in place.
gltf::ProgressiveAsset encoded_grid_asset(const Shape& shape);

/// The same as an elementary stream with the base embedded.
std::vector<std::uint8_t> encoded_stream(const Shape& shape);

}  // namespace zerotree::test
