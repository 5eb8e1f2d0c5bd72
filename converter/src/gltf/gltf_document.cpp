#include "gltf/gltf_document.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <string_view>
#include <utility>

#include "gltf/accessor_values.h"
#include "gltf/base_layout.h"
#include "gltf/glb_container.h"
#include "gltf/json_text.h"
#include "gltf/packed_view.h"
#include "gltf/percent_encoding.h"
#include "mesh/error.h"

namespace zerotree::gltf {
namespace {

constexpr std::uint64_t kByte = 5120;
constexpr std::uint64_t kUnsignedByte = 5121;
constexpr std::uint64_t kUnsignedShort = 5123;
constexpr std::uint64_t kUnsignedInt = 5125;
constexpr std::uint64_t kFloat = 5126;

// 0 for a number that is no type.
std::uint64_t component_type_of(const JsonCursor& component_type) {
  const double number = component_type.number();
  return number >= kByte && number <= kFloat ? component_type.unsigned_integer() : 0;
}

std::uint64_t index_size(const JsonCursor& component_type) {
  switch (component_type_of(component_type)) {
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

// 0 if `view` states none.
std::uint64_t stride_of(const JsonCursor& view) {
  const JsonCursor stride = view.member("byteStride");
  const std::uint64_t value = stride.unsigned_integer_or(0);
  if (stride.exists() && (value < 4 || value > 252))
    stride.fail(IssueCode::value_not_in_range, "4 to 252 bytes are expected");
  return value;
}

bool is_true(const JsonCursor& flag) {
  return flag.exists() && flag.value() == true;
}

void check_version(const JsonCursor& version) {
  const std::string text = version.string();
  const std::size_t point = text.find('.');
  const auto is_number = [](std::string_view digits) {
    return !digits.empty() && digits.find_first_not_of("0123456789") == digits.npos;
  };
  if (point == text.npos || !is_number(std::string_view(text).substr(0, point)) ||
      !is_number(std::string_view(text).substr(point + 1)))
    version.fail(IssueCode::pattern_mismatch, "\"" + text + "\" is not like 2.0");
  if (text.substr(0, point) != "2") version.fail(IssueCode::unknown_asset_major_version, text);
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

GltfDocument::GltfDocument(std::filesystem::path path, std::vector<std::uint8_t> file,
                           Issues& issues)
    : path_(std::move(path)), file_(std::move(file)) {
  parse(issues);
  const auto asset = json_.find("asset");
  // A missing version is one of many things that a check of all properties finds.
  if (asset == json_.end() || !asset->is_object() || !asset->contains("version")) return;
  if ((*asset)["version"].is_string()) check_version(root().member("asset").member("version"));
}

GltfDocument::GltfDocument(std::filesystem::path path, std::vector<std::uint8_t> file)
    : path_(std::move(path)), file_(std::move(file)) {
  Issues issues;
  parse(issues);
  const Issue* wrong = first_error(issues);
  if (wrong != nullptr && !is_truncated_) throw IssueFound(*wrong);
  check_version(root().member("asset").member("version"));
}

void GltfDocument::parse(Issues& issues) {
  std::string_view text(reinterpret_cast<const char*>(file_.data()), file_.size());
  is_binary_ = is_glb(file_);
  if (is_binary_) {
    const GlbChunks chunks = split_glb(file_, issues);
    text = chunks.json;
    if (chunks.has_binary) binary_chunk_ = chunks.binary;
    is_truncated_ = chunks.is_truncated;
  }
  json_ = parse_json(text);
}

std::optional<std::span<const std::uint8_t>> GltfDocument::stored(std::uint64_t index) {
  const JsonCursor uri = root().member("buffers").element(index).member("uri");
  if (uri.exists()) return load_uri(uri);
  return index == 0 ? binary_chunk_ : std::nullopt;
}

std::optional<std::uint64_t> GltfDocument::stored_bytes(std::uint64_t index) {
  const auto bytes = stored(index);
  return bytes ? std::optional<std::uint64_t>(bytes->size()) : std::nullopt;
}

std::span<const std::uint8_t> GltfDocument::buffer_bytes(std::uint64_t index) {
  const JsonCursor buffer = root().member("buffers").element(index);
  const std::uint64_t length = buffer.member("byteLength").unsigned_integer();
  const auto bytes = stored(index);
  if (!bytes && is_binary_ && index == 0) buffer.fail(IssueCode::buffer_missing_glb_data, "");
  if (!bytes)
    buffer.fail(IssueCode::buffer_too_short, "only the first buffer of a GLB needs no uri");
  return bytes->first(static_cast<std::size_t>(std::min<std::uint64_t>(bytes->size(), length)));
}

std::span<const std::uint8_t> GltfDocument::load_uri(const JsonCursor& uri) {
  const std::string text = uri.string();
  if (text.starts_with("data:")) {
    std::vector<std::uint8_t> bytes;
    std::string mime_type;
    if (const auto known = loaded_.find(text); known != loaded_.end()) return known->second;
    if (!tinygltf::IsDataURI(text) || !tinygltf::DecodeDataURI(&bytes, mime_type, text, 0, false))
      uri.fail(IssueCode::invalid_uri, "the data URI holds no base64 data");
    return loaded_[text] = std::move(bytes);
  }
  const std::filesystem::path relative =
      std::filesystem::path(percent_decoded(text)).lexically_normal();
  // What a hostile file names must not lead out of its folder.
  if (has_scheme(text) || relative.empty() || relative.native().find('\0') != std::string::npos ||
      relative.is_absolute() || *relative.begin() == "..")
    uri.fail(IssueCode::io_error, "\"" + text + "\" names no file in the folder of the glTF file");
  std::string key = "/";  // as no data URI begins
  key += relative.string();
  if (const auto known = loaded_.find(key); known != loaded_.end()) return known->second;
  try {
    return loaded_[key] = read_file(path_.parent_path() / relative);
  } catch (const Error& error) {
    uri.fail(IssueCode::io_error, error.what());
  }
}

std::span<const std::uint8_t> GltfDocument::buffer_part(const JsonCursor& place,
                                                        std::uint64_t offset,
                                                        std::uint64_t length) {
  const JsonCursor buffer = place.member("buffer").resolve(root().member("buffers"));
  const std::uint64_t buffer_length = buffer.member("byteLength").unsigned_integer();
  if (length == 0) place.member("byteLength").fail(IssueCode::value_not_in_range, "it is 0");
  if (buffer_length == 0)
    buffer.member("byteLength").fail(IssueCode::value_not_in_range, "it is 0");
  // Neither sum overflows: JsonCursor's integers end at 2^53.
  if (offset + length > buffer_length)
    throw IssueFound({IssueCode::buffer_view_too_long,
                      place.pointer() + (offset >= buffer_length ? "/byteOffset" : "/byteLength"),
                      "bytes " + std::to_string(offset) + " to " + std::to_string(offset + length) +
                          " of " + std::to_string(buffer_length)});
  const auto bytes = buffer_bytes(place.member("buffer").index());
  const std::size_t begin = std::min<std::uint64_t>(bytes.size(), offset);
  const std::size_t end = std::min<std::uint64_t>(bytes.size(), offset + length);
  return bytes.subspan(begin, end - begin);
}

JsonCursor GltfDocument::view(const JsonCursor& index) const {
  return index.resolve(root().member("bufferViews"));
}

ViewBytes GltfDocument::view_bytes(const JsonCursor& index) {
  const JsonCursor view = this->view(index);
  const std::uint64_t length = view.member("byteLength").unsigned_integer();
  return {buffer_part(view, view.member("byteOffset").unsigned_integer_or(0), length), length,
          stride_of(view)};
}

ViewBytes GltfDocument::unpacked_bytes(const JsonCursor& index) {
  const JsonCursor view = this->view(index);
  const JsonCursor packing = packing_of(view);
  if (!packing.exists()) return view_bytes(index);
  if (!lists("extensionsUsed", kPackingExtension))
    packing.fail(IssueCode::packing_broken, "extensionsUsed does not name the extension");
  const std::uint64_t number = index.index();
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
    packing.fail(IssueCode::packing_broken, "it unpacks to " + std::to_string(bytes.size()) +
                                                " bytes, not to the bufferView's byteLength");
  return {bytes, bytes.size(), stride_of(view)};
}

GltfDocument::Elements GltfDocument::elements(const JsonCursor& accessor,
                                              std::uint64_t element_size) {
  if (accessor.member("sparse").exists())
    accessor.fail(IssueCode::accessor_unsupported, "it is sparse");
  if (!accessor.member("bufferView").exists())
    accessor.fail(IssueCode::accessor_unsupported, "it has no bufferView");
  const std::uint64_t offset = accessor.member("byteOffset").unsigned_integer_or(0);
  const std::uint64_t count = accessor.member("count").unsigned_integer();
  const ViewBytes view = unpacked_bytes(accessor.member("bufferView"));
  const std::uint64_t stride = view.stride == 0 ? element_size : view.stride;
  const JsonCursor packing = packing_of(this->view(accessor.member("bufferView")));
  if (packing.exists() && packing.member("byteStride").unsigned_integer() != stride)
    packing.member("byteStride")
        .fail(IssueCode::packing_broken,
              "the accessor's elements lie " + std::to_string(stride) + " bytes apart");
  if (count == 0) accessor.member("count").fail(IssueCode::value_not_in_range, "it is 0");
  if (stride < element_size)
    accessor.fail(IssueCode::accessor_small_bytestride, std::to_string(stride) + " bytes");
  // Compared by division: stride times count may overflow.
  if (offset > view.length || view.length - offset < element_size ||
      (view.length - offset - element_size) / stride < count - 1)
    (offset > view.length ? accessor.member("byteOffset") : accessor)
        .fail(IssueCode::accessor_too_long, std::to_string(count) + " elements from byte " +
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
  const JsonCursor accessor = index.resolve(root().member("accessors"));
  const std::uint64_t type = component_type_of(accessor.member("componentType"));
  const std::size_t size = type == kUnsignedInt ? 0 : component_size(type);
  if (accessor.member("type").string() != "VEC3" || size == 0)
    accessor.fail(IssueCode::accessor_unsupported, "vectors are VEC3");
  if (type != kFloat) require_quantisation(accessor);
  const bool is_normalised = is_true(accessor.member("normalized")) && type != kFloat;
  const auto divisor = static_cast<float>(is_normalised ? component_range(type).second : 1);
  const Elements from = elements(accessor, 3 * size);
  std::vector<Eigen::Vector3f> vectors(from.count);
  for (std::size_t i = 0; i < from.count; ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      vectors[i][static_cast<Eigen::Index>(axis)] =
          static_cast<float>(
              read_component(from.bytes.data() + i * from.stride + axis * size, type)) /
          divisor;
    if (!vectors[i].allFinite())
      accessor.fail(IssueCode::accessor_invalid_float, "element " + std::to_string(i));
  }
  return vectors;
}

std::vector<std::uint32_t> GltfDocument::read_indices(const JsonCursor& index) {
  const JsonCursor accessor = index.resolve(root().member("accessors"));
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
