#include "import/gltf_container.h"

#include <tiny_gltf.h>

#include <algorithm>

#include "import/import_error.h"

namespace zerotree::importer {
namespace {

using nlohmann::json;

// JSON and binary chunk of a GLB.
struct GlbChunks {
  std::string_view json;
  std::string_view binary;
};

GlbChunks split_glb(const InputBytes& input) {
  constexpr std::uint32_t json_type = 0x4e4f534a, binary_type = 0x004e4942;
  const std::string_view bytes = input.bytes;
  const auto number_at = [&](std::size_t at) {
    return load_scalar<std::uint32_t>(bytes.data() + at, false);
  };
  if (bytes.size() < 20) refuse(input.name, "the GLB is truncated; fetch or export it again");
  if (number_at(4) != 2)
    refuse_at_byte(input.name, 4,
                   "GLB version " + std::to_string(number_at(4)) + " is not read; export glTF 2.0");
  if (number_at(8) > bytes.size())
    refuse_at_byte(input.name, bytes.size(),
                   "the GLB ends early: its header announces " + std::to_string(number_at(8)) +
                       " bytes; fetch or export it again");
  GlbChunks chunks;
  std::size_t at = 12;
  while (at + 8 <= number_at(8)) {
    const std::uint32_t length = number_at(at), type = number_at(at + 4);
    if (length > bytes.size() - at - 8)
      refuse_at_byte(input.name, at, "a GLB chunk is longer than the file; export it again");
    const std::string_view chunk = bytes.substr(at + 8, length);
    if (type == json_type && chunks.json.empty()) chunks.json = chunk;
    if (type == binary_type && chunks.binary.empty()) chunks.binary = chunk;
    at += 8 + std::size_t{length};
  }
  if (chunks.json.empty()) refuse(input.name, "the GLB has no JSON chunk; export it again");
  return chunks;
}

json parse_json(std::string_view text, const std::string& name) {
  // tinygltf walks extras and extensions recursively, so a deep one would overflow its stack.
  constexpr int deepest = 100;
  bool too_deep = false;
  const auto watch_depth = [&too_deep](int depth, json::parse_event_t, json&) {
    too_deep |= depth > deepest;
    return !too_deep;
  };
  json document;
  try {
    document = json::parse(text.begin(), text.end(), watch_depth);
  } catch (const json::parse_error& error) {
    refuse(name, "the glTF's JSON is damaged near its byte " + std::to_string(error.byte) +
                     "; export the file again");
  }
  if (too_deep) refuse(name, "the glTF's JSON is nested more than 100 deep; export it again");
  if (!document.is_object()) refuse(name, "the glTF's JSON is no object; export it again");
  return document;
}

std::string percent_decoded(const std::string& uri) {
  const auto digit = [](char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
  };
  std::string path;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    const bool escape =
        uri[i] == '%' && i + 2 < uri.size() && digit(uri[i + 1]) >= 0 && digit(uri[i + 2]) >= 0;
    path += escape ? static_cast<char>(digit(uri[i + 1]) * 16 + digit(uri[i + 2])) : uri[i];
    if (escape) i += 2;
  }
  return path;
}

std::string read_uri(const std::string& uri, const InputBytes& input,
                     const ImportOptions& options) {
  if (uri.starts_with("data:")) {
    std::vector<unsigned char> bytes;
    std::string mime_type;
    if (!tinygltf::DecodeDataURI(&bytes, mime_type, uri, 0, false))
      refuse(input.name, "a buffer's data URI cannot be decoded; export the file again");
    return std::string(bytes.begin(), bytes.end());
  }
  const std::filesystem::path relative = percent_decoded(uri);
  const bool outside = std::find(relative.begin(), relative.end(), "..") != relative.end();
  if (relative.is_absolute() || outside || uri.find("://") != uri.npos)
    refuse(input.name, "buffer " + in_quotes(uri) +
                           " does not lie in the file's folder; put it there and name it so");
  const std::filesystem::path path = input.path.parent_path() / relative;
  return read_whole_file(path, input.name + ", buffer " + in_quotes(uri),
                         options.max_decoded_bytes);
}

bool is_meshopt_fallback(const json& buffer) {
  const auto extensions = buffer.find("extensions");
  if (extensions == buffer.end() || !extensions->is_object()) return false;
  const auto meshopt = extensions->find("EXT_meshopt_compression");
  return meshopt != extensions->end() && meshopt->is_object() &&
         meshopt->value("fallback", json()) == json(true);
}

std::string read_buffer(const json& buffer, std::size_t index, std::string_view binary,
                        const InputBytes& input, const ImportOptions& options) {
  const auto uri = buffer.find("uri");
  if (uri == buffer.end() && is_meshopt_fallback(buffer)) return {};
  std::string bytes;
  if (uri == buffer.end()) {
    bytes = binary;
  } else if (uri->is_string()) {
    bytes = read_uri(uri->get_ref<const std::string&>(), input, options);
  }
  if (json_count(buffer, "byteLength", 0) > bytes.size())
    refuse(input.name, "buffer " + std::to_string(index) + " has " + std::to_string(bytes.size()) +
                           " bytes, fewer than its byteLength; fetch or export the file again");
  return bytes;
}

}  // namespace

std::uint64_t json_count(const json& object, const char* key, std::uint64_t otherwise) {
  const auto value = object.find(key);
  if (value == object.end() || !value->is_number_integer()) return otherwise;
  if (value->is_number_unsigned()) return value->get<std::uint64_t>();
  return value->get<std::int64_t>() < 0 ? otherwise : value->get<std::uint64_t>();
}

GltfContainer read_gltf_container(const InputBytes& input, const ImportOptions& options) {
  GltfContainer container;
  container.is_binary = input.bytes.starts_with("glTF");
  GlbChunks chunks{input.bytes, {}};
  if (container.is_binary) chunks = split_glb(input);
  container.document = parse_json(chunks.json, input.name);
  const auto buffers = container.document.find("buffers");
  if (buffers == container.document.end() || !buffers->is_array()) return container;
  std::uint64_t total = 0;
  for (const json& buffer : *buffers) {
    if (!buffer.is_object()) refuse(input.name, "a buffer that is no object; export it again");
    container.buffers.push_back(
        read_buffer(buffer, container.buffers.size(), chunks.binary, input, options));
    total += container.buffers.back().size();
    if (total > options.max_decoded_bytes)
      refuse(input.name, "the buffers hold more than the limit; simplify the mesh first");
  }
  return container;
}

}  // namespace zerotree::importer
