// Triangles as EXT_meshopt_compression packs them (mode TRIANGLES), each with its first corner
// kept.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace zerotree::gltf {

/// The packed form of `triangles`; any decoder of the extension returns them in their order, each
/// beginning with the same corner. meshoptimizer's own encoder turns triangles so that the edge
/// they share with an earlier one comes first, but first corners number the details of a
/// progressive mesh. Triangles in the order of a growing region take little more than a byte each.
std::vector<std::uint8_t> pack_triangles(std::span<const std::array<std::uint32_t, 3>> triangles);

}  // namespace zerotree::gltf
