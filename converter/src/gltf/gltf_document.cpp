#include "gltf/gltf_document.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <string_view>
#include <utility>

#include "gltf/base_layout.h"
#include "gltf/glb_container.h"
#include "gltf/packed_view.h"
#include "gltf/percent_encoding.h"
#include "mesh/error.h"

namespace zerotree::gltf {
namespace {

constexpr std::uint64_t kByte = 5120;
constexpr std::uint64_t kUnsignedByte = 5121;
constexpr std::uint64_t kShort = 5122;
constexpr std::uint64_t kUnsignedShort = 5123;
constexpr std::uint64_t kUnsignedInt = 5125;
constexpr std::uint64_t kFloat = 5126;

std::uint64_t index_size(const JsonCursor& component_type) {
  switch (component_type.unsigned_integer()) {
    case kUnsignedByte:
      return 1;
    case kUnsignedShort:
      return 2;
    case kUnsignedInt:
      return 4;
    default:
      component_type.fail(IssueCode::accessor_unsupported, "indices are unsigned integers");
  }
}

// Bytes of a component of a vector; 0 for a type that vectors do not have.
std::size_t component_size(std::uint64_t type) {
  if (type == kFloat) return sizeof(float);
  if (type == kByte || type == kUnsignedByte) return 1;
  return type == kShort || type == kUnsignedShort ? 2 : 0;
}

// What a normalized integer is divided by.
float largest_component(std::uint64_t type) {
  if (type == kByte) return 127;
  if (type == kUnsignedByte) return 255;
  if (type == kShort) return 32767;
  return type == kUnsignedShort ? 65535.0f : 1.0f;
}

template <class Component>
float as_float(const std::uint8_t* bytes) {
  Component value;
  std::memcpy(&value, bytes, sizeof value);
  return static_cast<float>(value);
}

float component(const std::uint8_t* bytes, std::uint64_t type) {
  if (type == kByte) return as_float<std::int8_t>(bytes);
  if (type == kUnsignedByte) return as_float<std::uint8_t>(bytes);
  if (type == kShort) return as_float<std::int16_t>(bytes);
  return type == kUnsignedShort ? as_float<std::uint16_t>(bytes) : as_float<float>(bytes);
}

bool is_true(const JsonCursor& flag) {
  return flag.exists() && flag.value() == true;
}

bool has_scheme(std::string_view uri) {
  const std::size_t colon = uri.find(':');
  return colon != std::string_view::npos && colon < uri.find('/');
}

}  // namespace

// The elements of an accessor: each of them lies in `bytes` at a multiple of `stride`.
struct GltfDocument::Elements {
  std::span<const std::uint8_t> bytes;
  std::size_t count;
  std::size_t stride;
};

std::vector<std::uint8_t> read_file(const std::filesystem::path& path) {
  std::error_code error;
  const auto fail = [&](const std::string& what) -> std::vector<std::uint8_t> {
    throw Error(ExitCode::unreadable_input, path.string() + ": " + what);
  };
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) return fail("there is no such file: check the name");
  if (!std::filesystem::is_regular_file(status)) return fail("is no file: name a regular file");
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  std::ifstream stream(path, std::ios::binary);
  if (error || !stream) return fail("cannot be opened: check that it may be read");
  std::vector<std::uint8_t> bytes(size);
  stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
  if (stream.gcount() != static_cast<std::streamsize>(size))
    return fail("changed or failed while it was read: try again");
  return bytes;
}

GltfDocument::GltfDocument(std::filesystem::path path, std::vector<std::uint8_t> file)
    : path_(std::move(path)), file_(std::move(file)) {
  std::string_view text(reinterpret_cast<const char*>(file_.data()), file_.size());
  is_binary_ = is_glb(file_);
  if (is_binary_) {
    const GlbChunks chunks = split_glb(file_);
    text = chunks.json;
    binary_chunk_ = chunks.binary;
    is_truncated_ = chunks.is_truncated;
  }
  try {
    json_ = nlohmann::json::parse(text);
  } catch (const nlohmann::json::exception& error) {
    throw IssueFound({IssueCode::json_invalid, "", error.what()});
  }
  const std::string version = root().member("asset").member("version").string();
  if (!version.starts_with("2."))
    throw IssueFound({IssueCode::gltf_version_unsupported, "/asset/version", version});
}

std::span<const std::uint8_t> GltfDocument::buffer_bytes(std::uint64_t index) {
  const JsonCursor buffer = root().member("buffers").element(index);
  const std::uint64_t length = buffer.member("byteLength").unsigned_integer();
  const JsonCursor uri = buffer.member("uri");
  std::span<const std::uint8_t> bytes = binary_chunk_;
  if (uri.exists()) {
    if (!loaded_.contains(index)) loaded_[index] = load_uri(uri);
    bytes = loaded_[index];
  } else if (!is_binary_ || index != 0) {
    uri.fail(IssueCode::buffer_unreadable, "only the first buffer of a GLB has no uri");
  }
  return bytes.first(static_cast<std::size_t>(std::min<std::uint64_t>(bytes.size(), length)));
}

std::vector<std::uint8_t> GltfDocument::load_uri(const JsonCursor& uri) const {
  const std::string text = uri.string();
  if (tinygltf::IsDataURI(text)) {
    std::vector<std::uint8_t> bytes;
    std::string mime_type;
    if (!tinygltf::DecodeDataURI(&bytes, mime_type, text, 0, false))
      uri.fail(IssueCode::buffer_unreadable, "the data URI holds no base64 data");
    return bytes;
  }
  const std::filesystem::path relative =
      std::filesystem::path(percent_decoded(text)).lexically_normal();
  // What a hostile file names must not lead out of its folder.
  if (has_scheme(text) || relative.empty() || relative.is_absolute() || *relative.begin() == "..")
    uri.fail(IssueCode::buffer_unreadable,
             "\"" + text + "\" names no file in the folder of the glTF file");
  try {
    return read_file(path_.parent_path() / relative);
  } catch (const Error& error) {
    uri.fail(IssueCode::buffer_unreadable, error.what());
  }
}

std::span<const std::uint8_t> GltfDocument::buffer_part(const JsonCursor& place,
                                                        std::uint64_t offset,
                                                        std::uint64_t length) {
  const std::uint64_t buffer = place.member("buffer").unsigned_integer();
  const JsonCursor buffers = root().member("buffers");
  if (buffer >= buffers.size())
    place.member("buffer").fail(
        IssueCode::index_unresolved,
        "buffer " + std::to_string(buffer) + " of " + std::to_string(buffers.size()));
  const std::uint64_t buffer_length =
      buffers.element(buffer).member("byteLength").unsigned_integer();
  // Neither sum overflows: JsonCursor's integers end at 2^53.
  if (length == 0 || offset + length > buffer_length)
    place.fail(IssueCode::view_out_of_buffer, "bytes " + std::to_string(offset) + " to " +
                                                  std::to_string(offset + length) + " of " +
                                                  std::to_string(buffer_length));
  const auto bytes = buffer_bytes(buffer);
  const std::size_t begin = std::min<std::uint64_t>(bytes.size(), offset);
  const std::size_t end = std::min<std::uint64_t>(bytes.size(), offset + length);
  return bytes.subspan(begin, end - begin);
}

JsonCursor GltfDocument::view(const JsonCursor& index) const {
  const std::uint64_t number = index.unsigned_integer();
  const JsonCursor views = root().member("bufferViews");
  if (number >= views.size())
    index.fail(IssueCode::index_unresolved,
               "bufferView " + std::to_string(number) + " of " + std::to_string(views.size()));
  return views.element(number);
}

ViewBytes GltfDocument::view_bytes(const JsonCursor& index) {
  const JsonCursor view = this->view(index);
  const std::uint64_t length = view.member("byteLength").unsigned_integer();
  return {buffer_part(view, view.member("byteOffset").unsigned_integer_or(0), length), length,
          view.member("byteStride").unsigned_integer_or(0)};
}

ViewBytes GltfDocument::unpacked_bytes(const JsonCursor& index) {
  const JsonCursor view = this->view(index);
  const JsonCursor packing = packing_of(view);
  if (!packing.exists()) return view_bytes(index);
  if (!lists("extensionsUsed", kPackingExtension))
    packing.fail(IssueCode::packing_broken, "extensionsUsed does not name the extension");
  const std::uint64_t number = index.unsigned_integer();
  if (!unpacked_.contains(number)) {
    // One at a time: many views may name the same few bytes, and each takes 64 times as much.
    unpacked_.clear();
    const std::uint64_t length = packing.member("byteLength").unsigned_integer();
    const auto packed =
        buffer_part(packing, packing.member("byteOffset").unsigned_integer_or(0), length);
    if (packed.size() < length)
      packing.fail(IssueCode::buffer_too_short,
                   std::to_string(length - packed.size()) + " bytes are missing");
    unpacked_[number] = unpack_view(packing, packed);
  }
  const std::vector<std::uint8_t>& bytes = unpacked_[number];
  if (view.member("byteLength").unsigned_integer() != bytes.size())
    view.member("byteLength")
        .fail(IssueCode::property_value, "it unpacks to " + std::to_string(bytes.size()));
  return {bytes, bytes.size(), view.member("byteStride").unsigned_integer_or(0)};
}

GltfDocument::Elements GltfDocument::elements(const JsonCursor& accessor,
                                              std::uint64_t element_size) {
  if (accessor.member("sparse").exists())
    accessor.fail(IssueCode::accessor_unsupported, "it is sparse");
  const std::uint64_t offset = accessor.member("byteOffset").unsigned_integer_or(0);
  const std::uint64_t count = accessor.member("count").unsigned_integer();
  const ViewBytes view = unpacked_bytes(accessor.member("bufferView"));
  const std::uint64_t stride = view.stride == 0 ? element_size : view.stride;
  const JsonCursor packing = packing_of(this->view(accessor.member("bufferView")));
  if (packing.exists() && packing.member("byteStride").unsigned_integer() != stride)
    packing.member("byteStride")
        .fail(IssueCode::packing_broken,
              "the accessor's elements lie " + std::to_string(stride) + " bytes apart");
  if (count == 0) accessor.member("count").fail(IssueCode::property_value, "it is 0");
  if (stride < element_size)
    accessor.fail(IssueCode::accessor_unsupported, "its elements overlap: see byteStride");
  // Compared by division: stride times count may overflow.
  if (offset > view.length || view.length - offset < element_size ||
      (view.length - offset - element_size) / stride < count - 1)
    accessor.fail(IssueCode::accessor_out_of_view, std::to_string(count) + " elements from byte " +
                                                       std::to_string(offset) + " in a view of " +
                                                       std::to_string(view.length) + " bytes");
  if (view.available.size() < offset + stride * (count - 1) + element_size)
    accessor.fail(IssueCode::buffer_too_short,
                  std::to_string(view.length - view.available.size()) + " bytes are missing");
  return {view.available.subspan(offset), count, stride};
}

bool GltfDocument::lists(const char* list, const char* extension) const {
  const JsonCursor names = root().member(list);
  for (std::size_t i = 0; i < names.size(); ++i)
    if (names.element(i).string() == extension) return true;
  return false;
}

void GltfDocument::require_quantisation(const JsonCursor& accessor) const {
  if (!lists("extensionsRequired", kQuantisationExtension))
    accessor.fail(IssueCode::accessor_unsupported,
                  "integers need KHR_mesh_quantization among extensionsRequired");
}

std::vector<Eigen::Vector3f> GltfDocument::read_vectors(const JsonCursor& index) {
  const JsonCursor accessor = root().member("accessors").element(index.unsigned_integer());
  const std::uint64_t type = accessor.member("componentType").unsigned_integer();
  const std::size_t size = component_size(type);
  if (accessor.member("type").string() != "VEC3" || size == 0)
    accessor.fail(IssueCode::accessor_unsupported, "vectors are VEC3");
  if (type != kFloat) require_quantisation(accessor);
  const float divisor = is_true(accessor.member("normalized")) ? largest_component(type) : 1;
  const Elements from = elements(accessor, 3 * size);
  std::vector<Eigen::Vector3f> vectors(from.count);
  for (std::size_t i = 0; i < from.count; ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      vectors[i][static_cast<Eigen::Index>(axis)] =
          component(from.bytes.data() + i * from.stride + axis * size, type) / divisor;
    if (!vectors[i].allFinite())
      accessor.fail(IssueCode::base_value_not_finite, "element " + std::to_string(i));
  }
  return vectors;
}

std::vector<std::uint32_t> GltfDocument::read_indices(const JsonCursor& index) {
  const JsonCursor accessor = root().member("accessors").element(index.unsigned_integer());
  if (accessor.member("type").string() != "SCALAR")
    accessor.fail(IssueCode::accessor_unsupported, "indices are SCALAR");
  const std::uint64_t size = index_size(accessor.member("componentType"));
  const Elements from = elements(accessor, size);
  std::vector<std::uint32_t> indices(from.count);
  for (std::size_t i = 0; i < from.count; ++i) {
    const std::uint8_t* bytes = from.bytes.data() + i * from.stride;
    for (std::uint64_t k = 0; k < size; ++k)
      indices[i] |= static_cast<std::uint32_t>(bytes[k]) << (8 * k);
  }
  return indices;
}

}  // namespace zerotree::gltf
