// BufferViews under EXT_meshopt_compression.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "gltf/json_cursor.h"

namespace zerotree::gltf {

inline constexpr const char* kPackingExtension = "EXT_meshopt_compression";

/// The object that says how the data of `view` is packed; exists() tells whether it is.
JsonCursor packing_of(const JsonCursor& view);

/// The data that `packed` stands for; `packing` is its packing_of(). Any bytes are safe, and no
/// more memory is taken than they can stand for. Throws IssueFound if they do not decode.
std::vector<std::uint8_t> unpack_view(const JsonCursor& packing,
                                      std::span<const std::uint8_t> packed);

/// `data`, elements of `stride` bytes (a multiple of 4), packed as mode ATTRIBUTES.
std::vector<std::uint8_t> pack_attributes(std::span<const std::uint8_t> data, std::size_t stride);

}  // namespace zerotree::gltf
