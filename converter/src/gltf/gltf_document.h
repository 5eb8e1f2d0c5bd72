// A glTF file with its JSON and its buffers; every reach into them is checked.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "gltf/json_cursor.h"

namespace zerotree::gltf {

/// All bytes of a regular file. Throws Error(unreadable_input) naming the file.
std::vector<std::uint8_t> read_file(const std::filesystem::path& path);

/// The bytes of a bufferView.
struct ViewBytes {
  /// What is there: fewer than `length` if the file was cut off.
  std::span<const std::uint8_t> available;
  std::uint64_t length = 0;
  /// Distance of two elements; 0 if the view does not state one.
  std::uint64_t stride = 0;
};

/// A glTF file in memory. Files named by buffers are read when they are first asked for. Spans
/// returned live as long as the document. Functions throw IssueFound for what is wrong with it.
class GltfDocument {
 public:
  /// Parses `file`, the content of `path`, as GLB or glTF JSON.
  GltfDocument(std::filesystem::path path, std::vector<std::uint8_t> file);
  GltfDocument(const GltfDocument&) = delete;
  GltfDocument& operator=(const GltfDocument&) = delete;

  const std::filesystem::path& path() const { return path_; }
  JsonCursor root() const { return JsonCursor(json_); }
  bool is_binary() const { return is_binary_; }
  /// The GLB is shorter than its header states.
  bool is_truncated() const { return is_truncated_; }

  /// The view `index` names, as it lies in its buffer; `index` is the place of the number.
  ViewBytes view_bytes(const JsonCursor& index);
  /// VEC3 values of the accessor that `index` names, all of them finite: floats, or with
  /// KHR_mesh_quantization integers. Packed views (EXT_meshopt_compression) are unpacked.
  std::vector<Eigen::Vector3f> read_vectors(const JsonCursor& index);
  /// Values of the index accessor that `index` names.
  std::vector<std::uint32_t> read_indices(const JsonCursor& index);

 private:
  struct Elements;
  // The first bytes of buffer `index`, at most its byteLength.
  std::span<const std::uint8_t> buffer_bytes(std::uint64_t index);
  // `length` bytes from `offset` on of the buffer that `place` names in its member `buffer`.
  std::span<const std::uint8_t> buffer_part(const JsonCursor& place, std::uint64_t offset,
                                            std::uint64_t length);
  // As view_bytes, but unpacked; lives until another view is unpacked.
  ViewBytes unpacked_bytes(const JsonCursor& index);
  Elements elements(const JsonCursor& accessor, std::uint64_t element_size);
  JsonCursor view(const JsonCursor& index) const;
  bool lists(const char* list, const char* extension) const;
  void require_quantisation(const JsonCursor& accessor) const;
  std::vector<std::uint8_t> load_uri(const JsonCursor& uri) const;

  std::filesystem::path path_;
  std::vector<std::uint8_t> file_;
  nlohmann::json json_;
  bool is_binary_ = false;
  bool is_truncated_ = false;
  std::span<const std::uint8_t> binary_chunk_;
  std::map<std::uint64_t, std::vector<std::uint8_t>> loaded_, unpacked_;
};

}  // namespace zerotree::gltf
