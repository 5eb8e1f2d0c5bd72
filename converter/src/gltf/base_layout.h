// Where and in which form the base mesh lies in a file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <vector>

#include "gltf/progressive_asset.h"

namespace zerotree::gltf {

inline constexpr const char* kQuantisationExtension = "KHR_mesh_quantization";

/// The forms a base mesh can have; all false is what every glTF viewer reads.
struct BaseForm {
  /// Positions are 16-bit integers and normals bytes (KHR_mesh_quantization).
  bool quantised = false;
  /// Vertices, or triangles, are packed (EXT_meshopt_compression).
  bool packs_vertices = false;
  bool packs_triangles = false;

  bool packs() const { return packs_vertices || packs_triangles; }
};

/// The data of the base and the JSON lists that describe it: accessor 0 holds the indices, 1 the
/// positions, 2 the normals if there are any.
struct BaseLayout {
  std::vector<std::uint8_t> bytes;
  nlohmann::ordered_json views = nlohmann::ordered_json::array();
  nlohmann::ordered_json accessors = nlohmann::ordered_json::array();
  /// Length of the packed views' data once unpacked, the byteLength of the buffer without data
  /// that they name; 0 if none is packed.
  std::size_t unpacked_length = 0;
};

/// A number with as few digits as tell its float32 from others; whole ones without a point.
nlohmann::ordered_json short_number(double value);
nlohmann::ordered_json short_numbers(const Eigen::Vector3f& vector);

/// All control points are integers that 16 bits hold, so that the form may be quantised.
bool fits_quantisation(const ProgressiveAsset& asset);

/// The base of `asset`, which must keep the extension's rules, in buffer 0. Packed views name
/// `unpacked_buffer` as the one that would hold their data.
BaseLayout lay_out_base(const ProgressiveAsset& asset, const BaseForm& form, int unpacked_buffer);

}  // namespace zerotree::gltf
