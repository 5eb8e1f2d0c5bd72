#include "gltf/progressive_writer.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <nlohmann/json.hpp>
#include <span>
#include <string>

#include "export/atomic_file.h"
#include "gltf/base_layout.h"
#include "gltf/glb_container.h"
#include "gltf/packed_view.h"
#include "gltf/percent_encoding.h"
#include "mesh/error.h"

namespace zerotree::gltf {
namespace {

using nlohmann::ordered_json;

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
              (asset.normals.empty() || asset.normals.size() == asset.base.vertex_count),
          "a base vertex needs a control point and, if any has one, a normal");
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
  require(asset.placement.scale > 0 && std::isfinite(asset.placement.scale) &&
              asset.placement.translation.allFinite(),
          "the node's placement is not finite");
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

ordered_json extension_json(const ProgressiveAsset& asset, std::size_t payload_view) {
  ordered_json prefixes = ordered_json::array();
  for (const PrefixEntry& entry : asset.prefixes)
    prefixes.push_back({{"byteLength", entry.byte_length},
                        {"geometricError", short_number(entry.geometric_error)}});
  return {{"bufferView", payload_view},
          {"levels", asset.levels},
          {"bounds",
           {{"min", short_numbers(asset.bounds_min)}, {"max", short_numbers(asset.bounds_max)}}},
          {"sourceDiagonal", short_number(asset.source_diagonal)},
          {"prefixes", std::move(prefixes)}};
}

// White and dull: glTF's own default is a metal, which is black where nothing shines on it.
ordered_json scan_material(bool is_double_sided) {
  ordered_json material{{"pbrMetallicRoughness", {{"metallicFactor", 0}}}};
  if (is_double_sided) material["doubleSided"] = true;
  return material;
}

ordered_json node_json(const Placement& placement) {
  ordered_json node{{"mesh", 0}};
  const Eigen::Vector3d& t = placement.translation;
  if (placement.scale != 1) node["scale"] = {placement.scale, placement.scale, placement.scale};
  if (!t.isZero(0)) node["translation"] = {t.x(), t.y(), t.z()};
  return node;
}

ordered_json mesh_json(const ProgressiveAsset& asset, std::size_t payload_view) {
  ordered_json primitive;
  primitive["attributes"]["POSITION"] = 1;
  if (!asset.normals.empty()) primitive["attributes"]["NORMAL"] = 2;
  primitive["indices"] = 0;
  primitive["material"] = 0;
  ordered_json mesh;
  if (!asset.name.empty()) mesh["name"] = asset.name;
  mesh["primitives"] = ordered_json::array({std::move(primitive)});
  mesh["extensions"][kExtensionName] = extension_json(asset, payload_view);
  return mesh;
}

void list_extensions(const BaseForm& form, ordered_json& json) {
  json["extensionsUsed"] = {kExtensionName};
  // There is no second, plain form of the data for readers without these.
  for (const auto& [is_used, name] : {std::pair{form.quantised, kQuantisationExtension},
                                      std::pair{form.packs(), kPackingExtension}})
    if (is_used) {
      json["extensionsUsed"].push_back(name);
      json["extensionsRequired"].push_back(name);
    }
}

// Names need not be UTF-8 on disk, JSON must be.
std::string dump(const ordered_json& json, int indent = -1) {
  return json.dump(indent, ' ', false, ordered_json::error_handler_t::replace);
}

// Files of buffers. Without a name, the base is in the GLB, and the payload behind the base.
struct BufferFiles {
  std::filesystem::path base, payload;

  bool is_split() const { return !payload.empty(); }
};

ordered_json buffer_json(const std::filesystem::path& file, std::size_t length) {
  ordered_json buffer;
  if (!file.empty()) buffer["uri"] = percent_encoded(file.filename().string());
  buffer["byteLength"] = length;
  return buffer;
}

// The last one has no data: packed views name it as the place of what they unpack to.
ordered_json buffers_json(const BufferFiles& files, const BaseLayout& base, std::size_t payload) {
  ordered_json buffers = ordered_json::array();
  if (files.is_split())
    buffers = {buffer_json(files.base, base.bytes.size()), buffer_json(files.payload, payload)};
  else
    buffers.push_back(buffer_json({}, base.bytes.size() + payload));
  if (base.unpacked_length > 0) {
    buffers.push_back(buffer_json({}, base.unpacked_length));
    buffers.back()["extensions"][kPackingExtension]["fallback"] = true;
  }
  return buffers;
}

struct GltfParts {
  ordered_json json;
  /// Data of the first buffer without the payload.
  std::vector<std::uint8_t> base;
};

GltfParts gltf_parts(const ProgressiveAsset& asset, const BaseForm& form,
                     const BufferFiles& files) {
  const bool is_split = files.is_split();
  BaseLayout base = lay_out_base(asset, form, is_split ? 2 : 1);
  // Between the two, so that the payload ends the file, whose length is a multiple of 4.
  if (!is_split)
    while ((base.bytes.size() + asset.payload.size()) % 4 != 0) base.bytes.push_back(0);
  ordered_json payload_view{{"buffer", is_split ? 1 : 0}};
  if (!is_split) payload_view["byteOffset"] = base.bytes.size();
  payload_view["byteLength"] = asset.payload.size();
  base.views.push_back(std::move(payload_view));

  ordered_json json;
  json["asset"]["version"] = "2.0";
  if (!asset.generator.empty()) json["asset"]["generator"] = asset.generator;
  list_extensions(form, json);
  json["scene"] = 0;
  json["scenes"] = ordered_json::array({{{"nodes", {0}}}});
  json["nodes"] = ordered_json::array({node_json(asset.placement)});
  json["meshes"] = ordered_json::array({mesh_json(asset, base.views.size() - 1)});
  json["materials"] = ordered_json::array({scan_material(has_boundary(asset.base))});
  json["accessors"] = std::move(base.accessors);
  json["bufferViews"] = std::move(base.views);
  json["buffers"] = buffers_json(files, base, asset.payload.size());
  return {std::move(json), std::move(base.bytes)};
}

// Every form the options and the asset allow, the plain one first.
std::vector<BaseForm> allowed_forms(const ProgressiveAsset& asset, const WriteOptions& options) {
  std::vector<BaseForm> forms;
  for (const bool quantised : {false, true})
    for (const bool packs_vertices : {false, true})
      for (const bool packs_triangles : {false, true})
        forms.push_back({quantised, packs_vertices, packs_triangles});
  const bool may_quantise = options.compress_base && fits_quantisation(asset);
  std::erase_if(forms, [&](const BaseForm& form) {
    return (form.packs() && !options.compress_base) || (form.quantised && !may_quantise);
  });
  return forms;
}

// The parts of the smallest file among the forms allowed.
GltfParts smallest_parts(const ProgressiveAsset& asset, const WriteOptions& options,
                         const BufferFiles& files) {
  check_rules(asset);
  GltfParts smallest;
  std::size_t smallest_size = 0;
  for (const BaseForm& form : allowed_forms(asset, options)) {
    GltfParts parts = gltf_parts(asset, form, files);
    const std::size_t size = dump(parts.json).size() + parts.base.size();
    if (smallest_size != 0 && size >= smallest_size) continue;
    smallest = std::move(parts);
    smallest_size = size;
  }
  return smallest;
}

void append(std::vector<std::uint8_t>& bytes, std::span<const std::uint8_t> more) {
  bytes.insert(bytes.end(), more.begin(), more.end());
}

struct SplitFiles {
  BufferFiles names;
  /// The .glb or .gltf file.
  std::vector<std::uint8_t> head;
  /// The base mesh beside a .gltf file.
  std::vector<std::uint8_t> base;
};

SplitFiles split_files(const std::filesystem::path& path, const ProgressiveAsset& asset,
                       const WriteOptions& options) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const bool is_binary = extension == ".glb";
  if (!is_binary && extension != ".gltf")
    throw Error(ExitCode::usage, path.string() + ": name a .glb or .gltf file to write");
  SplitFiles files;
  files.names.payload = std::filesystem::path(path).replace_extension(".zt.bin");
  if (!is_binary) files.names.base = std::filesystem::path(path).replace_extension(".bin");
  GltfParts parts = smallest_parts(asset, options, files.names);
  if (is_binary) {
    files.head = glb_head(dump(parts.json), parts.base.size());
    append(files.head, parts.base);
    files.head.resize((files.head.size() + 3) / 4 * 4);
  } else {
    const std::string text = dump(parts.json, 2) + "\n";
    files.head.assign(text.begin(), text.end());
    files.base = std::move(parts.base);
  }
  return files;
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

std::vector<std::uint8_t> glb_bytes(const ProgressiveAsset& asset, const WriteOptions& options) {
  const GltfParts parts = smallest_parts(asset, options, {});
  std::vector<std::uint8_t> bytes =
      glb_head(dump(parts.json), parts.base.size() + asset.payload.size());
  append(bytes, parts.base);
  append(bytes, asset.payload);
  return bytes;
}

void write_glb(const std::filesystem::path& path, const ProgressiveAsset& asset,
               const WriteOptions& options) {
  exporter::write_file_atomically(path, glb_bytes(asset, options));
}

std::uint64_t split_size(const std::filesystem::path& path, const ProgressiveAsset& asset,
                         const WriteOptions& options) {
  const SplitFiles files = split_files(path, asset, options);
  return files.head.size() + files.base.size() + asset.payload.size();
}

void write_split(const std::filesystem::path& path, const ProgressiveAsset& asset,
                 const WriteOptions& options) {
  const SplitFiles files = split_files(path, asset, options);
  exporter::StagedFile payload_file(files.names.payload);
  exporter::StagedFile gltf_file(path);
  payload_file.write(asset.payload);
  gltf_file.write(files.head);
  payload_file.seal();
  gltf_file.seal();
  if (!files.names.base.empty()) exporter::write_file_atomically(files.names.base, files.base);
  payload_file.commit();
  gltf_file.commit();
}

}  // namespace zerotree::gltf
