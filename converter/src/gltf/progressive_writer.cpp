#include "gltf/progressive_writer.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <span>
#include <string>

#include "export/atomic_file.h"
#include "gltf/glb_container.h"
#include "gltf/percent_encoding.h"
#include "mesh/error.h"

namespace zerotree::gltf {
namespace {

using nlohmann::ordered_json;

static_assert(std::endian::native == std::endian::little, "buffers are written as they lie");
static_assert(sizeof(Eigen::Vector3f) == 12);

constexpr int kArrayBuffer = 34962;
constexpr int kElementArrayBuffer = 34963;
constexpr int kUnsignedByte = 5121;
constexpr int kUnsignedShort = 5123;
constexpr int kUnsignedInt = 5125;
constexpr int kFloat = 5126;

void require(bool is_met, const char* rule) {
  if (!is_met) throw Error(ExitCode::internal, std::string("progressive glTF: ") + rule);
}

bool is_prefix_table(const ProgressiveAsset& asset) {
  const auto& table = asset.prefixes;
  if (table.empty() || table.back().byte_length != asset.payload.size()) return false;
  for (std::size_t i = 0; i < table.size(); ++i) {
    if (!(table[i].geometric_error >= 0) || !std::isfinite(table[i].geometric_error)) return false;
    if (i > 0 && table[i].byte_length <= table[i - 1].byte_length) return false;
    if (i > 0 && table[i].geometric_error > table[i - 1].geometric_error) return false;
  }
  return true;
}

void check_rules(const ProgressiveAsset& asset) {
  const auto all_finite = [](const std::vector<Eigen::Vector3f>& vectors) {
    return std::all_of(vectors.begin(), vectors.end(), [](const auto& v) { return v.allFinite(); });
  };
  require(!asset.control_points.empty() && !asset.base.triangles.empty(), "the base is empty");
  require(asset.control_points.size() == asset.base.vertex_count &&
              asset.normals.size() == asset.base.vertex_count,
          "a base vertex needs a control point and a normal");
  require(all_finite(asset.control_points) && all_finite(asset.normals),
          "the base has a value that is not finite");
  for (const auto& triangle : asset.base.triangles)
    for (std::uint32_t v : triangle)
      require(v < asset.base.vertex_count, "a base triangle names a vertex that does not exist");
  require(!asset.payload.empty(), "the payload is empty");
  require(asset.levels >= 0 && asset.levels <= kMaxLevels, "too many levels");
  require(is_prefix_table(asset),
          "prefixes must ascend to the payload's length and never rise in error");
  require(asset.bounds_min.allFinite() && asset.bounds_max.allFinite() &&
              (asset.bounds_min.array() <= asset.bounds_max.array()).all(),
          "bounds are not a box");
  require(asset.source_diagonal > 0 && std::isfinite(asset.source_diagonal),
          "the source's diagonal is not a length");
}

// A float32 with as few digits as tell it from its neighbours.
double shortest(double value) {
  char text[64];
  const auto end = std::to_chars(text, text + sizeof text, static_cast<float>(value)).ptr;
  double result = 0;
  std::from_chars(text, end, result);
  return result;
}

ordered_json corner(const Eigen::Vector3f& p) {
  return {shortest(p.x()), shortest(p.y()), shortest(p.z())};
}

// An open surface is seen from both sides.
bool has_boundary(const bitstream::BaseTopology& base) {
  std::vector<std::array<std::uint32_t, 2>> edges;
  for (const auto& t : base.triangles)
    for (int k = 0; k < 3; ++k)
      edges.push_back({std::min(t[k], t[(k + 1) % 3]), std::max(t[k], t[(k + 1) % 3])});
  std::sort(edges.begin(), edges.end());
  for (std::size_t i = 0; i < edges.size(); i += 2)
    if (i + 1 == edges.size() || edges[i] != edges[i + 1]) return true;
  return false;
}

// The data of the base and the JSON lists that describe it.
struct BaseBuffer {
  std::vector<std::uint8_t> bytes;
  ordered_json views = ordered_json::array();
  ordered_json accessors = ordered_json::array();

  // Appends a view of its own and an accessor over all of it; returns the accessor's index.
  std::size_t add(const void* data, std::size_t size, int target, ordered_json accessor) {
    bytes.resize((bytes.size() + 3) / 4 * 4);
    views.push_back(
        {{"buffer", 0}, {"byteOffset", bytes.size()}, {"byteLength", size}, {"target", target}});
    const auto* first = static_cast<const std::uint8_t*>(data);
    bytes.insert(bytes.end(), first, first + size);
    accessor["bufferView"] = views.size() - 1;
    accessors.push_back(std::move(accessor));
    return accessors.size() - 1;
  }
};

template <class Index>
std::size_t add_indices(BaseBuffer& buffer, const bitstream::BaseTopology& base, int type) {
  std::vector<Index> indices;
  for (const auto& triangle : base.triangles)
    for (std::uint32_t v : triangle) indices.push_back(static_cast<Index>(v));
  return buffer.add(indices.data(), indices.size() * sizeof(Index), kElementArrayBuffer,
                    {{"componentType", type}, {"count", indices.size()}, {"type", "SCALAR"}});
}

// In the smallest type: with 112 base vertices 32 bit would cost 2 kB, a quarter of what the
// details of a good surface need. The largest value of each type is reserved (primitive restart).
std::size_t add_indices(BaseBuffer& buffer, const bitstream::BaseTopology& base) {
  if (base.vertex_count <= 0xff) return add_indices<std::uint8_t>(buffer, base, kUnsignedByte);
  if (base.vertex_count <= 0xffff) return add_indices<std::uint16_t>(buffer, base, kUnsignedShort);
  return add_indices<std::uint32_t>(buffer, base, kUnsignedInt);
}

std::size_t add_vectors(BaseBuffer& buffer, const std::vector<Eigen::Vector3f>& vectors,
                        bool with_bounds) {
  ordered_json accessor{{"componentType", kFloat}, {"count", vectors.size()}, {"type", "VEC3"}};
  if (with_bounds) {
    Eigen::Vector3f low = vectors.front(), high = vectors.front();
    for (const Eigen::Vector3f& v : vectors) {
      low = low.cwiseMin(v);
      high = high.cwiseMax(v);
    }
    accessor["min"] = corner(low);
    accessor["max"] = corner(high);
  }
  return buffer.add(vectors.data(), vectors.size() * sizeof(Eigen::Vector3f), kArrayBuffer,
                    std::move(accessor));
}

ordered_json extension_json(const ProgressiveAsset& asset, std::size_t payload_view) {
  ordered_json prefixes = ordered_json::array();
  for (const PrefixEntry& entry : asset.prefixes)
    prefixes.push_back(
        {{"byteLength", entry.byte_length}, {"geometricError", shortest(entry.geometric_error)}});
  return {{"bufferView", payload_view},
          {"levels", asset.levels},
          {"attributes", ordered_json::array({"POSITION"})},
          {"bounds", {{"min", corner(asset.bounds_min)}, {"max", corner(asset.bounds_max)}}},
          {"sourceDiagonal", shortest(asset.source_diagonal)},
          {"prefixes", std::move(prefixes)}};
}

// Grey and dull, as scans without colours are shown.
ordered_json scan_material(bool is_double_sided) {
  ordered_json material{{"pbrMetallicRoughness",
                         {{"baseColorFactor", {0.8, 0.8, 0.8, 1.0}},
                          {"metallicFactor", 0.0},
                          {"roughnessFactor", 0.8}}}};
  if (is_double_sided) material["doubleSided"] = true;
  return material;
}

struct GltfParts {
  ordered_json json;
  /// Data of the first buffer without the payload; its length is a multiple of 4.
  std::vector<std::uint8_t> base;
};

// `payload_buffer` is 0 if the payload follows the base in the first buffer, else 1. The list of
// buffers is left to the caller, who knows where they lie.
GltfParts gltf_parts(const ProgressiveAsset& asset, int payload_buffer) {
  check_rules(asset);
  BaseBuffer base;
  ordered_json primitive;
  primitive["indices"] = add_indices(base, asset.base);
  primitive["attributes"]["POSITION"] = add_vectors(base, asset.control_points, true);
  primitive["attributes"]["NORMAL"] = add_vectors(base, asset.normals, false);
  primitive["material"] = 0;
  base.views.push_back({{"buffer", payload_buffer},
                        {"byteOffset", payload_buffer == 0 ? base.bytes.size() : 0},
                        {"byteLength", asset.payload.size()}});
  ordered_json mesh{{"primitives", ordered_json::array({std::move(primitive)})}};
  mesh["extensions"][kExtensionName] = extension_json(asset, base.views.size() - 1);
  ordered_json node{{"mesh", 0}};
  if (!asset.name.empty()) mesh["name"] = node["name"] = asset.name;

  ordered_json json;
  json["asset"]["version"] = "2.0";
  if (!asset.generator.empty()) json["asset"]["generator"] = asset.generator;
  json["extensionsUsed"] = {kExtensionName};
  json["scene"] = 0;
  json["scenes"] = ordered_json::array({{{"nodes", {0}}}});
  json["nodes"] = ordered_json::array({std::move(node)});
  json["meshes"] = ordered_json::array({std::move(mesh)});
  json["materials"] = ordered_json::array({scan_material(has_boundary(asset.base))});
  json["accessors"] = std::move(base.accessors);
  json["bufferViews"] = std::move(base.views);
  return {std::move(json), std::move(base.bytes)};
}

// Names need not be UTF-8 on disk, JSON must be.
std::string dump(const ordered_json& json, int indent = -1) {
  return json.dump(indent, ' ', false, ordered_json::error_handler_t::replace);
}

ordered_json external_buffer(const std::filesystem::path& file, std::size_t length) {
  return {{"uri", percent_encoded(file.filename().string())}, {"byteLength", length}};
}

void append(std::vector<std::uint8_t>& bytes, std::span<const std::uint8_t> more) {
  bytes.insert(bytes.end(), more.begin(), more.end());
}

}  // namespace

std::vector<PrefixEntry> monotone_prefixes(std::vector<PrefixEntry> measured) {
  std::sort(measured.begin(), measured.end(), [](const PrefixEntry& a, const PrefixEntry& b) {
    return a.byte_length != b.byte_length ? a.byte_length < b.byte_length
                                          : a.geometric_error > b.geometric_error;
  });
  const auto same_length = [](const PrefixEntry& a, const PrefixEntry& b) {
    return a.byte_length == b.byte_length;
  };
  measured.erase(std::unique(measured.begin(), measured.end(), same_length), measured.end());
  for (std::size_t i = measured.size(); i-- > 1;)
    measured[i - 1].geometric_error =
        std::max(measured[i - 1].geometric_error, measured[i].geometric_error);
  return measured;
}

std::vector<std::uint8_t> glb_bytes(const ProgressiveAsset& asset) {
  GltfParts parts = gltf_parts(asset, 0);
  const std::size_t length = parts.base.size() + asset.payload.size();
  parts.json["buffers"] = ordered_json::array({{{"byteLength", length}}});
  std::vector<std::uint8_t> bytes = glb_head(dump(parts.json), length);
  append(bytes, parts.base);
  append(bytes, asset.payload);
  bytes.resize((bytes.size() + 3) / 4 * 4);
  return bytes;
}

void write_glb(const std::filesystem::path& path, const ProgressiveAsset& asset) {
  exporter::write_file_atomically(path, glb_bytes(asset));
}

void write_split(const std::filesystem::path& path, const ProgressiveAsset& asset) {
  const bool is_binary = path.extension() == ".glb";
  if (!is_binary && path.extension() != ".gltf")
    throw Error(ExitCode::usage, path.string() + ": name a .glb or .gltf file to write");
  const std::filesystem::path payload_path =
      std::filesystem::path(path).replace_extension(".zt.bin");
  const std::filesystem::path base_path = std::filesystem::path(path).replace_extension(".bin");
  GltfParts parts = gltf_parts(asset, 1);
  parts.json["buffers"] =
      ordered_json::array({is_binary ? ordered_json{{"byteLength", parts.base.size()}}
                                     : external_buffer(base_path, parts.base.size()),
                           external_buffer(payload_path, asset.payload.size())});

  std::vector<std::uint8_t> head;
  if (is_binary) {
    head = glb_head(dump(parts.json), parts.base.size());
    append(head, parts.base);
  } else {
    const std::string text = dump(parts.json, 2) + "\n";
    head.assign(text.begin(), text.end());
  }
  exporter::StagedFile payload_file(payload_path);
  exporter::StagedFile gltf_file(path);
  payload_file.write(asset.payload);
  gltf_file.write(head);
  payload_file.seal();
  gltf_file.seal();
  if (!is_binary) exporter::write_file_atomically(base_path, parts.base);
  payload_file.commit();
  gltf_file.commit();
}

}  // namespace zerotree::gltf
