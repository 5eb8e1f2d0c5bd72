// The values of glTF accessors, decompressed and checked against their buffers.
#pragma once

#include <tiny_gltf.h>

#include <optional>
#include <string>
#include <vector>

#include "import/gltf_container.h"

namespace zerotree::importer {

/// Reads accessors of one file: sparse ones, quantised and normalised ones
/// (KHR_mesh_quantization), and buffer views under EXT_meshopt_compression. What lies outside its
/// buffer is Error(unreadable_input). Holds references to what it was made from.
class GltfAccessors {
 public:
  GltfAccessors(const tinygltf::Model& model, const GltfContainer& container,
                const ImportOptions& options, const std::string& file);

  /// Number of elements; refuses an accessor that is not there.
  std::size_t count(int accessor) const;
  /// Components per element, 1 to 4; refuses matrices.
  int components(int accessor) const;
  /// All values, `components()` per element, normalised integers as their fraction.
  std::vector<double> values(int accessor);
  /// All values of an unsigned integer scalar accessor.
  std::vector<std::uint32_t> indices(int accessor);
  /// The bytes of a buffer view that is not compressed.
  std::string_view view_bytes(int view) const;

 private:
  struct Elements {
    std::string_view bytes;
    std::size_t stride = 0;
  };
  const tinygltf::Accessor& get(int accessor) const;
  std::string_view decoded_view(int view);
  std::string decode_meshopt(const nlohmann::json& extension, int view) const;
  Elements elements(int view, std::size_t offset, std::size_t count, std::size_t element_size);
  void overlay_sparse(const tinygltf::Accessor& accessor, std::vector<double>& values);

  const tinygltf::Model& model_;
  const GltfContainer& container_;
  const ImportOptions& options_;
  const std::string& file_;
  std::vector<std::optional<std::string>> decoded_views_;
};

}  // namespace zerotree::importer
