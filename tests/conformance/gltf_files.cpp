// Files for validators. The codes are written down by hand, as extension-spec/VALIDATION.md has
// them; `zerotree validate` must find these and no others.
#include <cstddef>
#include <fstream>
#include <functional>
#include <iterator>
#include <nlohmann/json.hpp>
#include <span>
#include <utility>

#include "conformance_cases.h"
#include "encoded_assets.h"
#include "gltf/glb_container.h"
#include "gltf/progressive_writer.h"
#include "sample_assets.h"

namespace zerotree::conformance {
namespace {

using nlohmann::json;
using Asset = gltf::ProgressiveAsset;

// Parts of the JSON of `right_asset()`.
constexpr std::size_t kPayloadView = 2, kPositionAccessor = 1, kIndexAccessor = 2;

Asset right_asset() {
  return test::encoded_asset({"tetrahedron", test::tetrahedron(), {}, {}});
}

json& extension(json& root) {
  return root["meshes"][0]["extensions"][gltf::kExtensionName];
}

Bytes glb_of(const json& root, std::span<const std::uint8_t> binary) {
  Bytes bytes = gltf::glb_head(root.dump(), binary.size());
  bytes.insert(bytes.end(), binary.begin(), binary.end());
  return bytes;
}

/// The right file with other JSON.
Bytes with_json(const std::function<void(json&)>& change) {
  const Bytes whole = gltf::glb_bytes(right_asset());
  const gltf::GlbChunks chunks = gltf::split_glb(whole);
  json root = json::parse(chunks.json);
  change(root);
  return glb_of(root, chunks.binary);
}

/// The file of the right asset, changed.
Bytes with_asset(const std::function<void(Asset&)>& change) {
  Asset asset = right_asset();
  change(asset);
  return gltf::glb_bytes(asset);
}

Bytes text_bytes(const std::string& text) {
  return {text.begin(), text.end()};
}

// Large enough for EXT_meshopt_compression to save bytes.
Asset grid_asset() {
  return test::encoded_grid_asset({"sphere", test::in_canonical_order(test::sphere(2)), {}, {}});
}

Bytes broken_packing() {
  Bytes bytes = gltf::glb_bytes(grid_asset(), {.compress_base = true});
  const std::size_t binary = bytes.size() - gltf::split_glb(bytes).binary.size();
  bytes[binary] ^= 0x80;  // the header of the vertices' packed data
  return bytes;
}

/// The right file with other bytes at the beginning of the accessor's data.
Bytes with_data(std::size_t accessor, std::initializer_list<std::uint8_t> data) {
  Bytes bytes = gltf::glb_bytes(right_asset());
  const gltf::GlbChunks chunks = gltf::split_glb(bytes);
  const json root = json::parse(chunks.json);
  const std::size_t view = root["accessors"][accessor]["bufferView"];
  const std::size_t begin = bytes.size() - chunks.binary.size() +
                            root["bufferViews"][view].value("byteOffset", std::size_t{0});
  std::copy(data.begin(), data.end(), bytes.begin() + static_cast<std::ptrdiff_t>(begin));
  return bytes;
}

FileCase split(std::string name, std::vector<std::string> codes, int exit_code) {
  const test::TemporaryFolder folder;
  gltf::write_split(folder / name, right_asset());
  FileCase result{name, std::move(codes), exit_code, {}, {}};
  for (const std::string& file : folder.file_names()) {
    std::ifstream in(folder / file, std::ios::binary);
    Bytes bytes{std::istreambuf_iterator<char>(in), {}};
    if (file == name)
      result.bytes = std::move(bytes);
    else
      result.side_files.push_back({file, std::move(bytes)});
  }
  return result;
}

/// A payload of a buffer of its own of which only half is there.
FileCase half_payload() {
  FileCase result = split("payload-truncated.gltf", {"PAYLOAD_TRUNCATED", "PAYLOAD_INCOMPLETE"}, 1);
  for (SideFile& side : result.side_files)
    if (side.name.ends_with(".zt.bin")) side.bytes.resize(side.bytes.size() / 2);
  return result;
}

/// A defect in JSON.
struct JsonDefect {
  const char* name;
  std::vector<std::string> codes;
  int exit_code;
  std::function<void(json&)> change;
};

// clang-format off
const std::vector<JsonDefect>& json_defects() {
  static const std::vector<JsonDefect> defects = {
      {"extension-not-listed.glb", {"EXTENSION_NOT_LISTED"}, 1,
       [](json& r) { r.erase("extensionsUsed"); }},
      {"extension-required.glb", {"EXTENSION_REQUIRED"}, 1,
       [](json& r) { r["extensionsRequired"] = {gltf::kExtensionName}; }},
      {"extension-misplaced.glb", {"EXTENSION_MISPLACED"}, 1,
       [](json& r) { r["bufferViews"][0]["extensions"][gltf::kExtensionName] = json::object(); }},
      {"property-missing.glb", {"PROPERTY_MISSING"}, 1,
       [](json& r) { extension(r).erase("prefixes"); }},
      {"property-type.glb", {"PROPERTY_TYPE"}, 1,
       [](json& r) { extension(r)["levels"] = "two"; }},
      {"levels-15.glb", {"PROPERTY_VALUE"}, 1, [](json& r) { extension(r)["levels"] = 15; }},
      {"bounds-min-above-max.glb", {"PROPERTY_VALUE"}, 1,
       [](json& r) { extension(r)["bounds"]["min"][1] = 99; }},
      {"property-unknown.glb", {"PROPERTY_UNKNOWN"}, 0,
       [](json& r) { extension(r)["levles"] = 2; }},
      {"index-unresolved.glb", {"INDEX_UNRESOLVED"}, 1,
       [](json& r) { extension(r)["bufferView"] = 77; }},
      {"prefix-bytes-descend.glb", {"PREFIX_ORDER"}, 1,
       [](json& r) { extension(r)["prefixes"][2]["byteLength"] = 1; }},
      {"prefix-error-rises.glb", {"PREFIX_ORDER"}, 1,
       [](json& r) { extension(r)["prefixes"][3]["geometricError"] = 9.5; }},
      {"prefix-end.glb", {"PREFIX_END"}, 1, [](json& r) { extension(r)["prefixes"].erase(4); }},
      {"buffer-unreadable.glb", {"BUFFER_UNREADABLE", "BUFFER_UNREADABLE"}, 1,
       [](json& r) { r["buffers"][0]["uri"] = "gone.bin"; }},
      {"view-out-of-buffer.glb", {"VIEW_OUT_OF_BUFFER"}, 1,
       [](json& r) { r["bufferViews"][kPayloadView]["byteLength"] = 1 << 20; }},
      {"accessor-out-of-view.glb", {"ACCESSOR_OUT_OF_VIEW"}, 1,
       [](json& r) { r["accessors"][kPositionAccessor]["count"] = 1000; }},
      {"accessor-unsupported.glb", {"ACCESSOR_UNSUPPORTED"}, 1,
       [](json& r) { r["accessors"][kPositionAccessor]["type"] = "VEC2"; }},
      {"base-of-strips.glb", {"BASE_UNSUPPORTED"}, 1,
       [](json& r) { r["meshes"][0]["primitives"][0]["mode"] = 5; }},
      {"base-index-out-of-range.glb", {"BASE_INDEX_OUT_OF_RANGE"}, 1,
       [](json& r) { r["accessors"][1]["count"] = 3; r["accessors"][2]["count"] = 3; }},
      {"payload-view-target.glb", {"PAYLOAD_VIEW_INVALID"}, 1,
       [](json& r) { r["bufferViews"][kPayloadView]["target"] = 34962; }},
      {"payload-not-last.glb", {"PAYLOAD_NOT_LAST"}, 1,
       [](json& r) { r["bufferViews"][kPayloadView]["byteLength"] = 8; }},
      {"payload-levels-mismatch.glb", {"PAYLOAD_LEVELS_MISMATCH"}, 1,
       [](json& r) { extension(r)["levels"] = 1; }},
      {"payload-too-large.glb", {"PAYLOAD_TOO_LARGE"}, 1,
       [](json& r) { extension(r)["levels"] = 14; }},
      {"surface-out-of-bounds.glb", std::vector<std::string>(5, "SURFACE_OUT_OF_BOUNDS"), 1,
       [](json& r) { extension(r)["bounds"]["max"][0] = 0.1; }},
      {"gltf-1.glb", {"GLTF_VERSION_UNSUPPORTED"}, 1,
       [](json& r) { r["asset"]["version"] = "1.0"; }},
      {"extension-absent.glb", {"EXTENSION_ABSENT"}, 0, [](json& r) {
         r["meshes"][0].erase("extensions"); r.erase("extensionsUsed"); }},
  };
  return defects;
}

/// Files whose bytes are made otherwise.
std::vector<FileCase> other_files() {
  const Bytes right = gltf::glb_bytes(right_asset());
  const Bytes cut(right.begin(), right.end() - 16);
  Bytes malformed = right;
  malformed[16] ^= 0x01;  // the type of the JSON chunk
  Bytes version_3 = right;
  version_3[4] = 3;
  const Bytes stream = test::encoded_stream({"tetrahedron", test::tetrahedron(), {}, {}});
  const Bytes half_stream(stream.begin(), stream.begin() + std::ptrdiff_t(stream.size() / 2));
  Bytes broken_stream = stream;
  broken_stream[2] ^= 0x03;
  return {
      {"right.glb", {}, 0, right, {}},
      {"right-quantised.glb", {}, 0, gltf::glb_bytes(grid_asset()), {}},
      {"right-compressed.glb", {}, 0, gltf::glb_bytes(grid_asset(), {.compress_base = true}), {}},
      {"right.zt", {}, 0, stream, {}},
      {"cut.zt", {"PAYLOAD_INCOMPLETE"}, 0, half_stream, {}},
      {"broken.zt", {"PAYLOAD_BROKEN"}, 1, broken_stream, {}},
      {"cut.glb", {"GLB_TRUNCATED", "PAYLOAD_TRUNCATED", "PAYLOAD_INCOMPLETE"}, 1, cut, {}},
      {"malformed.glb", {"GLB_MALFORMED"}, 1, malformed, {}},
      {"glb-version-3.glb", {"GLB_MALFORMED"}, 1, version_3, {}},
      {"unknown.bin", {"FILE_FORMAT_UNKNOWN"}, 1, text_bytes("solid cube"), {}},
      {"no-json.gltf", {"JSON_INVALID"}, 1, text_bytes("{\"asset\":"), {}},
      {"packing-broken.glb", {"PACKING_BROKEN"}, 1, broken_packing(), {}},
      {"payload-broken.glb", {"PAYLOAD_BROKEN"}, 1,
       with_asset([](Asset& a) { a.payload[0] ^= 1; }), {}},
      {"payload-base-mismatch.glb", {"PAYLOAD_BASE_MISMATCH"}, 1,
       with_asset([](Asset& a) { a.control_points[2].x() += 0.001f; }), {}},
      {"base-turned-over.glb", {"BASE_UNSUPPORTED"}, 1,
       with_asset([](Asset& a) { std::swap(a.base.triangles[0][0], a.base.triangles[0][1]); }), {}},
      {"base-not-finite.glb", {"BASE_VALUE_NOT_FINITE"}, 1, 
       with_data(kPositionAccessor, {0x00, 0x00, 0x80, 0x7f}), {}},
      {"surface-not-finite.glb", {"SURFACE_NOT_FINITE", "SURFACE_NOT_FINITE"}, 1,
       gltf::glb_bytes(test::encoded_asset({"tetrahedron", test::tetrahedron(), {}, {}}, 1e41)), {}},
      {"buffer-too-short.glb", {"GLB_TRUNCATED", "BUFFER_TOO_SHORT"}, 1,
       Bytes(right.begin(), right.end() - std::ptrdiff_t(gltf::split_glb(right).binary.size()) + 8),
       {}},
      split("right-split.gltf", {}, 0),
      half_payload(),
  };
}
// clang-format on

}  // namespace

std::vector<FileCase> file_cases() {
  std::vector<FileCase> files = other_files();
  for (const JsonDefect& defect : json_defects())
    files.push_back({defect.name, defect.codes, defect.exit_code, with_json(defect.change), {}});
  return files;
}

}  // namespace zerotree::conformance
