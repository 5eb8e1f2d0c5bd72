// A glTF file with its JSON and its buffers; every reach into them is checked.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
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
  /// Parses `file`, the content of `path`, as GLB or glTF JSON. What is wrong with a GLB container
  /// but leaves its JSON readable goes to `issues`. A version that is there is 2.something.
  GltfDocument(std::filesystem::path path, std::vector<std::uint8_t> file, Issues& issues);
  /// The same; throws for the first error in the container unless it is that the file was cut off,
  /// and if there is no version.
  GltfDocument(std::filesystem::path path, std::vector<std::uint8_t> file);
  GltfDocument(const GltfDocument&) = delete;
  GltfDocument& operator=(const GltfDocument&) = delete;

  const std::filesystem::path& path() const { return path_; }
  JsonCursor root() const { return JsonCursor(json_); }
  bool is_binary() const { return is_binary_; }
  /// The GLB is shorter than its header states.
  bool is_truncated() const { return is_truncated_; }
  /// Bytes that there are for buffer `index`, more or fewer than its byteLength; nothing if it has
  /// no uri and is not the binary chunk.
  std::optional<std::uint64_t> stored_bytes(std::uint64_t index);

  /// The view `index` names, as it lies in its buffer; `index` is the place of the number.
  ViewBytes view_bytes(const JsonCursor& index);
  /// As view_bytes, but unpacked (EXT_meshopt_compression); lives until another view is unpacked.
  ViewBytes unpacked_bytes(const JsonCursor& index);
  /// VEC3 values of the accessor that `index` names, all of them finite: floats, or with
  /// KHR_mesh_quantization integers. Packed views (EXT_meshopt_compression) are unpacked.
  std::vector<Eigen::Vector3f> read_vectors(const JsonCursor& index);
  /// Values of the index accessor that `index` names.
  std::vector<std::uint32_t> read_indices(const JsonCursor& index);

 private:
  struct Elements;
  void parse(Issues& issues);
  std::optional<std::span<const std::uint8_t>> stored(std::uint64_t index);
  // The first bytes of buffer `index`, at most its byteLength.
  std::span<const std::uint8_t> buffer_bytes(std::uint64_t index);
  // `length` bytes from `offset` on of the buffer that `place` names in its member `buffer`.
  std::span<const std::uint8_t> buffer_part(const JsonCursor& place, std::uint64_t offset,
                                            std::uint64_t length);
  Elements elements(const JsonCursor& accessor, std::uint64_t element_size);
  JsonCursor view(const JsonCursor& index) const;
  bool lists(const char* list, const char* extension) const;
  void require_quantisation(const JsonCursor& accessor) const;
  std::span<const std::uint8_t> load_uri(const JsonCursor& uri);

  std::filesystem::path path_;
  std::vector<std::uint8_t> file_;
  nlohmann::json json_;
  bool is_binary_ = false;
  bool is_truncated_ = false;
  std::optional<std::span<const std::uint8_t>> binary_chunk_;
  // By path, or by the text of a data URI: many buffers may name the same file.
  std::map<std::string, std::vector<std::uint8_t>, std::less<>> loaded_;
  std::map<std::uint64_t, std::vector<std::uint8_t>> unpacked_;
};

}  // namespace zerotree::gltf
