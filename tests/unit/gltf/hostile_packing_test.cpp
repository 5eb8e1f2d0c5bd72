// Base meshes under EXT_meshopt_compression and KHR_mesh_quantization from anybody.
#include <gtest/gtest.h>

#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <random>

#include "gltf/glb_container.h"
#include "gltf/packed_view.h"
#include "gltf/progressive_reader.h"
#include "gltf/progressive_writer.h"
#include "sample_assets.h"

namespace zerotree::gltf {
namespace {

using nlohmann::json;

constexpr std::size_t kPayloadSize = 40;

const std::vector<std::uint8_t>& compressed_file() {
  static const std::vector<std::uint8_t> bytes = glb_bytes(
      test::grid_asset({"sphere", test::in_canonical_order(test::sphere(2)), {}, {}}, kPayloadSize),
      {.compress_base = true});
  return bytes;
}

std::optional<ProgressiveAsset> read_bytes(const std::vector<std::uint8_t>& bytes, Issues& issues) {
  try {
    GltfDocument document("a.glb", bytes);
    const auto meshes = progressive_meshes(document, issues);
    if (meshes.empty()) throw IssueFound({IssueCode::extension_absent, "", ""});
    return read_mesh(document, meshes.front(), issues);
  } catch (const IssueFound& found) {
    issues.push_back(found.issue());
    return std::nullopt;
  }
}

std::vector<std::uint8_t> with_json(const std::function<void(json&)>& change) {
  const GlbChunks chunks = split_glb(compressed_file());
  json root = json::parse(chunks.json);
  change(root);
  std::vector<std::uint8_t> bytes = glb_head(root.dump(), chunks.binary.size());
  bytes.insert(bytes.end(), chunks.binary.begin(), chunks.binary.end());
  return bytes;
}

json& packing(json& root, std::size_t view) {
  return root["bufferViews"][view]["extensions"][kPackingExtension];
}

// The code of what is found first, empty if the file is read.
std::string refusal(const std::function<void(json&)>& change) {
  Issues issues;
  if (read_bytes(with_json(change), issues)) return "";
  return issues.empty() ? "nothing" : issue_text(issues.front().code).id;
}

TEST(HostilePacking, TheFileItselfIsReadAndPacksBothViews) {
  json root = json::parse(split_glb(compressed_file()).json);
  EXPECT_TRUE(packing(root, 0).is_object() && packing(root, 1).is_object());
  EXPECT_EQ(refusal([](json&) {}), "");
}

// No memory is taken for sizes that the data cannot fill.
TEST(HostilePacking, SizesBeyondTheDataAreRefused) {
  for (std::size_t view : {0, 1})
    for (double count : {4294967296.0, 9007199254740992.0, 3e6, 0.0})
      EXPECT_EQ(refusal([&](json& r) { packing(r, view)["count"] = count; }), "PACKING_BROKEN");
}

TEST(HostilePacking, FormsThatDoNotExistAreRefused) {
  EXPECT_EQ(refusal([](json& r) { packing(r, 0)["byteStride"] = 0; }), "VALUE_NOT_IN_RANGE");
  EXPECT_EQ(refusal([](json& r) { packing(r, 0)["byteStride"] = 260; }), "VALUE_NOT_IN_RANGE");
  EXPECT_EQ(refusal([](json& r) { packing(r, 0)["byteStride"] = 6; }), "PACKING_BROKEN");
  EXPECT_EQ(refusal([](json& r) { packing(r, 1)["byteStride"] = 3; }), "PACKING_BROKEN");
  EXPECT_EQ(refusal([](json& r) { packing(r, 1)["mode"] = "QUADS"; }), "PACKING_BROKEN");
  EXPECT_EQ(refusal([](json& r) { packing(r, 1)["mode"] = "INDICES"; }), "PACKING_BROKEN");
  EXPECT_EQ(refusal([](json& r) { packing(r, 1)["count"] = 961; }), "PACKING_BROKEN");
  EXPECT_EQ(refusal([](json& r) { packing(r, 0)["filter"] = "OCTAHEDRAL"; }),
            "ACCESSOR_UNSUPPORTED");
  EXPECT_EQ(refusal([](json& r) { packing(r, 0)["filter"] = "NONE"; }), "");
}

TEST(HostilePacking, PlacesOutsideTheFileAreRefused) {
  EXPECT_EQ(refusal([](json& r) { packing(r, 0)["buffer"] = 9; }), "UNRESOLVED_REFERENCE");
  EXPECT_EQ(refusal([](json& r) { packing(r, 0)["buffer"] = 1; }), "BUFFER_TOO_SHORT");
  EXPECT_EQ(refusal([](json& r) { packing(r, 0)["byteLength"] = 1 << 30; }),
            "BUFFER_VIEW_TOO_LONG");
  EXPECT_EQ(refusal([](json& r) { packing(r, 0)["byteOffset"] = 9007199254740992; }),
            "BUFFER_VIEW_TOO_LONG");
  EXPECT_EQ(refusal([](json& r) { r["bufferViews"][0]["byteLength"] = 8; }), "PACKING_BROKEN");
}

TEST(HostilePacking, ThePayloadMustNotBePacked) {
  Issues issues;
  read_bytes(with_json([](json& r) { packing(r, 2) = packing(r, 0); }), issues);
  ASSERT_FALSE(issues.empty());
  EXPECT_EQ(issues.front().code, IssueCode::payload_view_invalid);
}

TEST(HostilePacking, IntegersNeedTheirExtension) {
  EXPECT_EQ(refusal([](json& r) { r["extensionsRequired"] = {kPackingExtension}; }),
            "ACCESSOR_UNSUPPORTED");
  EXPECT_EQ(refusal([](json& r) { r["accessors"][1]["normalized"] = true; }),
            "ACCESSOR_UNSUPPORTED");
  EXPECT_EQ(refusal([](json& r) { r["accessors"][1]["componentType"] = 5125; }),
            "ACCESSOR_UNSUPPORTED");
}

// Each value of the document, replaced by values of other types and sizes, one at a time.
TEST(HostilePacking, TheExtensionMustBeNamed) {
  EXPECT_EQ(refusal([](json& root) { root["extensionsUsed"] = {kExtensionName}; }),
            "PACKING_BROKEN");
}

TEST(HostilePacking, TheStrideMustBeTheAccessors) {
  EXPECT_EQ(refusal([](json& root) {
              json& triangles = packing(root, 1);
              const int stride = triangles["byteStride"];
              triangles["byteStride"] = 6 - stride;
              root["bufferViews"][1]["byteLength"] = triangles["count"].get<int>() * (6 - stride);
            }),
            "PACKING_BROKEN");
}

TEST(HostilePacking, EveryValueIsReadOrRefused) {
  const json whole = json::parse(split_glb(compressed_file()).json).flatten();
  const std::vector<json> replacements = {
      nullptr, true, -1, 0, 1, 2, 3, 7, 1e9, 9007199254740992, 1e300, "abc", json::array(), -0.5};
  for (const auto& [pointer, value] : whole.items())
    for (const json& replacement : replacements) {
      Issues issues;
      const auto asset = read_bytes(
          with_json([&](json& root) { root[json::json_pointer(pointer)] = replacement; }), issues);
      ASSERT_TRUE(asset.has_value() || !issues.empty()) << pointer << " = " << replacement;
    }
}

TEST(HostilePacking, EveryLengthIsReadOrRefused) {
  const std::vector<std::uint8_t>& whole = compressed_file();
  for (std::size_t length = 0; length < whole.size(); ++length) {
    Issues issues;
    const auto read = read_bytes({whole.begin(), whole.begin() + std::ptrdiff_t(length)}, issues);
    // Bytes between base and payload are not needed.
    if (length >= whole.size() - kPayloadSize) {
      ASSERT_TRUE(read.has_value()) << length;
    }
    ASSERT_NE(first_error(issues), nullptr) << length;
  }
}

TEST(HostilePacking, EveryByteMayBeWrong) {
  const std::vector<std::uint8_t>& whole = compressed_file();
  const std::size_t begin = whole.size() - split_glb(whole).binary.size();
  std::mt19937 random(2);
  for (std::size_t at = begin; at < whole.size(); ++at)
    for (int round = 0; round < 8; ++round) {
      std::vector<std::uint8_t> bytes = whole;
      bytes[at] = static_cast<std::uint8_t>(random());
      bytes[begin + random() % (whole.size() - begin)] = static_cast<std::uint8_t>(random());
      Issues issues;
      const auto asset = read_bytes(bytes, issues);
      ASSERT_TRUE(asset.has_value() || !issues.empty());
    }
}

}  // namespace
}  // namespace zerotree::gltf
