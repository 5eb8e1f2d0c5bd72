// Files for validators. The codes are written down by hand, as extension-spec/VALIDATION.md has
// them; `zerotree validate` must find these and no others.
#include <algorithm>
#include <cstddef>
#include <fstream>
#include <functional>
#include <iterator>
#include <nlohmann/json.hpp>
#include <span>
#include <stdexcept>
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
  FileCase result =
      split("payload-truncated.gltf",
            {"BUFFER_BYTE_LENGTH_MISMATCH", "PAYLOAD_TRUNCATED", "PAYLOAD_INCOMPLETE"}, 1);
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
      {"extension-not-listed.glb", {"UNDECLARED_EXTENSION"}, 1,
       [](json& r) { r.erase("extensionsUsed"); }},
      {"extension-required.glb", {"EXTENSION_REQUIRED"}, 1,
       [](json& r) { r["extensionsRequired"] = {gltf::kExtensionName}; }},
      {"extension-misplaced.glb", {"EXTENSION_MISPLACED"}, 1,
       [](json& r) { r["bufferViews"][0]["extensions"][gltf::kExtensionName] = json::object(); }},
      {"property-missing.glb", {"UNDEFINED_PROPERTY"}, 1,
       [](json& r) { extension(r).erase("prefixes"); }},
      {"property-type.glb", {"TYPE_MISMATCH"}, 1,
       [](json& r) { extension(r)["levels"] = "two"; }},
      {"levels-15.glb", {"VALUE_NOT_IN_RANGE"}, 1, [](json& r) { extension(r)["levels"] = 15; }},
      {"bounds-min-above-max.glb", {"VALUE_NOT_IN_RANGE"}, 1,
       [](json& r) { extension(r)["bounds"]["min"][1] = 99; }},
      {"property-unknown.glb", {"UNEXPECTED_PROPERTY"}, 0,
       [](json& r) { extension(r)["levles"] = 2; }},
      {"index-unresolved.glb", {"UNRESOLVED_REFERENCE"}, 1,
       [](json& r) { extension(r)["bufferView"] = 77; }},
      {"prefix-bytes-descend.glb", {"PREFIX_ORDER"}, 1,
       [](json& r) { extension(r)["prefixes"][2]["byteLength"] = 1; }},
      {"prefix-error-rises.glb", {"PREFIX_ORDER"}, 1,
       [](json& r) { extension(r)["prefixes"][3]["geometricError"] = 9.5; }},
      {"prefix-end.glb", {"PREFIX_END"}, 1, [](json& r) { extension(r)["prefixes"].erase(4); }},
      {"buffer-unreadable.glb", {"IO_ERROR"}, 1,
       [](json& r) { r["buffers"][0]["uri"] = "gone.bin"; }},
      {"view-out-of-buffer.glb", {"BUFFER_VIEW_TOO_LONG"}, 1,
       [](json& r) { r["bufferViews"][kPayloadView]["byteLength"] = 1 << 20; }},
      {"accessor-out-of-view.glb", {"ACCESSOR_TOO_LONG", "MESH_PRIMITIVE_UNEQUAL_ACCESSOR_COUNT"}, 1,
       [](json& r) { r["accessors"][kPositionAccessor]["count"] = 1000; }},
      {"accessor-unsupported.glb", {"ARRAY_LENGTH_NOT_IN_LIST", "ARRAY_LENGTH_NOT_IN_LIST", "MESH_PRIMITIVE_POSITION_ACCESSOR_WITHOUT_BOUNDS", "MESH_PRIMITIVE_ATTRIBUTES_ACCESSOR_INVALID_FORMAT", "ACCESSOR_UNSUPPORTED"}, 1,
       [](json& r) { r["accessors"][kPositionAccessor]["type"] = "VEC2"; }},
      {"base-of-strips.glb", {"BASE_UNSUPPORTED"}, 1,
       [](json& r) { r["meshes"][0]["primitives"][0]["mode"] = 5; }},
      {"base-index-out-of-range.glb", {"ACCESSOR_INDEX_OOB"}, 1,
       [](json& r) { r["accessors"][1]["count"] = 3; r["accessors"][2]["count"] = 3; }},
      {"payload-view-target.glb", {"PAYLOAD_VIEW_INVALID"}, 1,
       [](json& r) { r["bufferViews"][kPayloadView]["target"] = 34962; }},
      {"payload-not-last.glb", {"PAYLOAD_NOT_LAST"}, 1,
       [](json& r) { r["bufferViews"][kPayloadView]["byteLength"] = 8; }},
      {"payload-levels-mismatch.glb", {"PAYLOAD_LEVELS_MISMATCH"}, 1,
       [](json& r) { extension(r)["levels"] = 1; }},
      {"payload-too-large.glb", {"PAYLOAD_TOO_LARGE"}, 1,
       [](json& r) { extension(r)["levels"] = 14; }},
      {"surface-out-of-bounds.glb", {"SURFACE_OUT_OF_BOUNDS", "SURFACE_OUT_OF_BOUNDS", "SURFACE_OUT_OF_BOUNDS",
        "SURFACE_OUT_OF_BOUNDS", "SURFACE_OUT_OF_BOUNDS", "PREFIX_OUT_OF_BOUNDS"}, 1,
       [](json& r) { extension(r)["bounds"]["max"][0] = 0.1; }},
      {"gltf-1.glb", {"UNKNOWN_ASSET_MAJOR_VERSION"}, 1,
       [](json& r) { r["asset"]["version"] = "1.0"; }},
      {"attributes-unsupported.glb", {"ATTRIBUTES_UNSUPPORTED"}, 1,
       [](json& r) { extension(r)["attributes"] = {"NORMAL"}; }},
      {"bounds-loose.glb", {"BOUNDS_LOOSE"}, 0,
       [](json& r) { extension(r)["bounds"]["max"][2] = 99; }},
      {"source-diagonal-implausible.glb", {"SOURCE_DIAGONAL_IMPLAUSIBLE"}, 0,
       [](json& r) { extension(r)["sourceDiagonal"] = 1000; }},
      {"position-max-too-small.glb", {"ACCESSOR_MAX_MISMATCH", "ACCESSOR_ELEMENT_OUT_OF_MAX_BOUND"}, 1,
       [](json& r) { r["accessors"][kPositionAccessor]["max"][0] = 0.125; }},
      {"node-loop.glb", {"NODE_LOOP", "SCENE_NON_ROOT_NODE"}, 1,
       [](json& r) { r["nodes"][0]["children"] = {0}; }},
      {"extension-listed-twice.glb", {"DUPLICATE_ELEMENTS"}, 1,
       [](json& r) { r["extensionsUsed"].push_back(gltf::kExtensionName); }},
      {"extension-absent.glb", {"EXTENSION_ABSENT"}, 0, [](json& r) {
         r["meshes"][0].erase("extensions"); r.erase("extensionsUsed"); }},
  };
  return defects;
}

/// Two sheets that meet in a line with vertices of their own, whose details differ there.
Asset sheets() {
  const TriangleMesh mesh = test::disjoint_union(test::grid(2, 2), test::grid(2, 2), {2, 0, 0});
  return test::encoded_asset({"sheets", mesh, {}, {}});
}

/// A primitive for each sheet.
Bytes cracked_sheets() {
  const Bytes whole = gltf::glb_bytes(sheets());
  const gltf::GlbChunks chunks = gltf::split_glb(whole);
  json root = json::parse(chunks.json);
  json& primitives = root["meshes"][0]["primitives"];
  json& first = root["accessors"][primitives[0]["indices"].get<std::size_t>()];
  const std::size_t half = first["count"].get<std::size_t>() / 2;
  first["count"] = half;
  json second = first;
  second["byteOffset"] = half;  // of bytes
  root["accessors"].push_back(second);
  primitives.push_back(primitives[0]);
  primitives[1]["indices"] = root["accessors"].size() - 1;
  return glb_of(root, chunks.binary);
}

void add_trailing_bytes(Asset& asset) {
  asset.payload.insert(asset.payload.end(), 5, 0xaa);
  asset.payload_length += 5;
  asset.prefixes.push_back({asset.payload_length, asset.prefixes.back().geometric_error / 2});
}

/// An entry of the table lies behind the stream's end and before the payload's.
void add_entry_behind_stream(Asset& asset) {
  add_trailing_bytes(asset);
  asset.prefixes.insert(asset.prefixes.end() - 1,
                        {asset.payload_length - 3, asset.prefixes.back().geometric_error});
}

/// The right file with text of its JSON chunk replaced by other text of the same length.
Bytes with_text(const std::string& text, const std::string& by) {
  Bytes bytes = gltf::glb_bytes(right_asset());
  const auto place = std::search(bytes.begin(), bytes.end(), text.begin(), text.end());
  if (place == bytes.end() || text.size() != by.size()) throw std::logic_error(text);
  std::copy(by.begin(), by.end(), place);
  return bytes;
}

Bytes stream_named(const std::string& name) {
  for (StreamCase& stream : stream_cases())
    if (stream.name == name) return std::move(stream.bytes);
  throw std::logic_error(name);
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
      {"right-early_end.zt", {}, 0, stream_named("early_end"), {}},
      {"cut.zt", {"PAYLOAD_INCOMPLETE"}, 0, half_stream, {}},
      {"broken.zt", {"PAYLOAD_BROKEN"}, 1, broken_stream, {}},
      {"cut.glb", {"GLB_UNEXPECTED_END_OF_CHUNK_DATA", "PAYLOAD_TRUNCATED", "PAYLOAD_INCOMPLETE"}, 1, cut, {}},
      {"malformed.glb", {"GLB_UNKNOWN_CHUNK_TYPE", "GLB_UNEXPECTED_FIRST_CHUNK"}, 1, malformed, {}},
      {"glb-version-3.glb", {"GLB_INVALID_VERSION"}, 1, version_3, {}},
      {"unknown.bin", {"FILE_FORMAT_UNKNOWN"}, 1, text_bytes("solid cube"), {}},
      {"no-json.gltf", {"INVALID_JSON"}, 1, text_bytes("{\"asset\":"), {}},
      {"packing-broken.glb", {"PACKING_BROKEN"}, 1, broken_packing(), {}},
      {"payload-broken.glb", {"PAYLOAD_BROKEN"}, 1,
       with_asset([](Asset& a) { a.payload[0] ^= 1; }), {}},
      {"payload-base-mismatch.glb", {"PAYLOAD_BASE_MISMATCH"}, 1,
       with_asset([](Asset& a) { a.control_points[2].x() += 0.001f; }), {}},
      {"base-turned-over.glb", {"BASE_UNSUPPORTED"}, 1,
       with_asset([](Asset& a) { std::swap(a.base.triangles[0][0], a.base.triangles[0][1]); }), {}},
      {"base-not-finite.glb", {"ACCESSOR_INVALID_FLOAT", "ACCESSOR_MAX_MISMATCH", "ACCESSOR_ELEMENT_OUT_OF_MAX_BOUND"}, 1, 
       with_data(kPositionAccessor, {0x00, 0x00, 0x80, 0x7f}), {}},
      {"surface-not-finite.glb", std::vector<std::string>(3, "SURFACE_NOT_FINITE"), 1,
       gltf::glb_bytes(test::encoded_asset({"tetrahedron", test::tetrahedron(), {}, {}}, 1e41)), {}},
      {"buffer-too-short.glb", {"GLB_UNEXPECTED_END_OF_CHUNK_DATA", "BUFFER_TOO_SHORT"}, 1,
       Bytes(right.begin(), right.end() - std::ptrdiff_t(gltf::split_glb(right).binary.size()) + 8),
       {}},
      {"payload-trailing-bytes.glb", {"PAYLOAD_TRAILING_BYTES"}, 0, with_asset(add_trailing_bytes), {}},
      {"prefix-beyond-stream.glb", {"PAYLOAD_TRAILING_BYTES", "PREFIX_BEYOND_STREAM"}, 0,
       with_asset(add_entry_behind_stream), {}},
      {"seam-open.glb", {"BASE_SEAM", "SURFACE_SEAM_OPEN"}, 0, gltf::glb_bytes(sheets()), {}},
      {"cracked.glb", {"BASE_SEAM", "SURFACE_CRACKED"}, 1, cracked_sheets(), {}},
      {"json-not-utf8.glb", {"INVALID_JSON"}, 1,
       with_text("\"generator\":\"zero", "\"generator\":\"z\xe8ro"), {}},
      {"json-key-twice.glb", {"JSON_KEY_REPEATED"}, 1, with_text("\"scenes\"", "\"meshes\""), {}},
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
