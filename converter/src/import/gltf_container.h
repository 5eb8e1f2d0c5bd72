// The outer layer of a glTF file: its JSON and its buffers, whichever way they are packed.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "import/imported_mesh.h"
#include "import/input_bytes.h"

namespace zerotree::importer {

struct GltfContainer {
  bool is_binary = false;
  nlohmann::json document;
  /// Bytes of each buffer, at least its byteLength; empty for a meshopt fallback buffer, which has
  /// no bytes of its own.
  std::vector<std::string> buffers;
};

/// Reads a GLB, or JSON with data URIs and files beside it. tinygltf is not asked to do this: it
/// refuses buffers longer than stated and the fallback buffers of EXT_meshopt_compression. Throws
/// Error(unreadable_input).
GltfContainer read_gltf_container(const InputBytes& input, const ImportOptions& options);

/// `object[key]` as a non-negative integer, or `otherwise` if there is none or it is no such
/// number.
std::uint64_t json_count(const nlohmann::json& object, const char* key, std::uint64_t otherwise);

}  // namespace zerotree::importer
