#include <gtest/gtest.h>

#include <functional>
#include <nlohmann/json.hpp>
#include <random>

#include "export/atomic_file.h"
#include "gltf/glb_container.h"
#include "gltf/progressive_reader.h"
#include "gltf/progressive_writer.h"
#include "mesh/error.h"
#include "sample_assets.h"

namespace zerotree::gltf {
namespace {

using nlohmann::json;
using test::TemporaryFolder;

constexpr std::size_t kPayloadSize = 40;

ProgressiveAsset small_asset() {
  return test::sample_asset({"tetrahedron", test::tetrahedron(), {}, {}}, kPayloadSize);
}

// Reads `bytes` from an exactly sized buffer; the asset, or nothing if it was refused properly.
std::optional<ProgressiveAsset> read_bytes(const std::vector<std::uint8_t>& bytes, Issues& issues) {
  try {
    GltfDocument document("small.glb", bytes);
    const auto meshes = progressive_meshes(document, issues);
    if (meshes.empty()) throw IssueFound({IssueCode::extension_absent, "", ""});
    return read_mesh(document, meshes.front(), issues);
  } catch (const IssueFound& found) {
    issues.push_back(found.issue());
    return std::nullopt;
  }
}

TEST(TruncatedGlb, EveryLengthIsReadOrRefused) {
  const ProgressiveAsset asset = small_asset();
  const std::vector<std::uint8_t> whole = glb_bytes(asset);
  const std::size_t payload_begin = whole.size() - kPayloadSize;
  for (std::size_t length = 0; length < whole.size(); ++length) {
    Issues issues;
    const auto read = read_bytes({whole.begin(), whole.begin() + std::ptrdiff_t(length)}, issues);
    ASSERT_EQ(read.has_value(), length >= payload_begin) << length;
    ASSERT_NE(first_error(issues), nullptr) << length;
    if (!read) continue;
    EXPECT_EQ(read->payload.size(), length - payload_begin);
    EXPECT_EQ(read->payload_length, kPayloadSize);
    EXPECT_EQ(first_error(issues)->code, IssueCode::payload_truncated);
    EXPECT_TRUE(std::equal(read->payload.begin(), read->payload.end(), asset.payload.begin()));
  }
}

TEST(TruncatedGlb, FilesOpenAsLongAsTheBaseIsThere) {
  const TemporaryFolder folder;
  const std::vector<std::uint8_t> whole = glb_bytes(small_asset());
  exporter::write_file_atomically(folder / "cut.glb", std::span(whole).first(whole.size() - 25));
  EXPECT_EQ(read_progressive(folder / "cut.glb").payload.size(), kPayloadSize - 25);
  exporter::write_file_atomically(folder / "cut.glb",
                                  std::span(whole).first(whole.size() - kPayloadSize - 1));
  try {
    read_progressive(folder / "cut.glb");
    FAIL() << "a base that is cut off was read";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::unreadable_input);
    EXPECT_NE(std::string(error.what()).find("cut.glb: /accessors/0"), std::string::npos)
        << error.what();
  }
}

TEST(TruncatedSplit, AShortPayloadFileIsAPrefixAMissingOneAnError) {
  const TemporaryFolder folder;
  write_split(folder / "a.glb", small_asset());
  std::filesystem::resize_file(folder / "a.zt.bin", 7);
  EXPECT_EQ(read_progressive(folder / "a.glb").payload.size(), 7u);
  std::filesystem::remove(folder / "a.zt.bin");
  EXPECT_THROW(read_progressive(folder / "a.glb"), Error);
}

// The small file with its JSON changed.
std::vector<std::uint8_t> with_json(const std::function<void(json&)>& change) {
  const std::vector<std::uint8_t> whole = glb_bytes(small_asset());
  const GlbChunks chunks = split_glb(whole);
  json root = json::parse(chunks.json);
  change(root);
  std::vector<std::uint8_t> bytes = glb_head(root.dump(), chunks.binary.size());
  bytes.insert(bytes.end(), chunks.binary.begin(), chunks.binary.end());
  return bytes;
}

// Each value of the document, replaced by values of other types and sizes, one at a time.
TEST(MutatedJson, EveryValueIsReadOrRefused) {
  const json whole = json::parse(split_glb(glb_bytes(small_asset())).json).flatten();
  const std::vector<json> replacements = {nullptr,
                                          true,
                                          -1,
                                          0,
                                          1,
                                          7,
                                          1e9,
                                          4294967295u,
                                          9007199254740992,
                                          1e300,
                                          "abc",
                                          json::array(),
                                          json::object(),
                                          json::parse("[[1]]"),
                                          -0.5};
  int refused = 0;
  for (const auto& [pointer, value] : whole.items())
    for (const json& replacement : replacements) {
      Issues issues;
      const auto asset = read_bytes(
          with_json([&](json& root) { root[json::json_pointer(pointer)] = replacement; }), issues);
      refused += !asset.has_value();
      ASSERT_TRUE(asset.has_value() || !issues.empty()) << pointer << " = " << replacement;
    }
  EXPECT_GT(refused, 100);
}

TEST(MutatedJson, EveryMissingMemberIsReadOrRefused) {
  const json whole = json::parse(split_glb(glb_bytes(small_asset())).json);
  std::vector<json::json_pointer> members;
  const std::function<void(const json&, const json::json_pointer&)> walk =
      [&](const json& value, const json::json_pointer& at) {
        if (!value.is_structured()) return;
        for (const auto& [key, child] : value.items()) {
          const json::json_pointer place =
              value.is_array() ? at / std::size_t(std::stoul(key)) : at / key;
          if (value.is_object()) members.push_back(place);
          walk(child, place);
        }
      };
  walk(whole, json::json_pointer());
  for (const json::json_pointer& member : members) {
    Issues issues;
    const auto asset = read_bytes(
        with_json([&](json& root) { root[member.parent_pointer()].erase(member.back()); }), issues);
    ASSERT_TRUE(asset.has_value() || !issues.empty()) << member;
  }
}

TEST(CorruptedGlb, RandomBytesAreReadOrRefused) {
  const std::vector<std::uint8_t> whole = glb_bytes(small_asset());
  std::mt19937 random(1);
  for (int round = 0; round < 4000; ++round) {
    std::vector<std::uint8_t> bytes = whole;
    for (int k = 0; k < 3; ++k)
      bytes[random() % bytes.size()] = static_cast<std::uint8_t>(random());
    Issues issues;
    const auto asset = read_bytes(bytes, issues);
    ASSERT_TRUE(asset.has_value() || !issues.empty());
  }
}

TEST(HostileJson, DeepNestingIsRefused) {
  std::string text = "{\"asset\":{\"version\":\"2.0\"},\"x\":";
  text += std::string(200000, '[') + std::string(200000, ']') + "}";
  Issues issues;
  EXPECT_FALSE(read_bytes({text.begin(), text.end()}, issues).has_value());
}

TEST(HostileJson, BuffersStayBesideTheFile) {
  const TemporaryFolder folder;
  for (const char* uri :
       {"/etc/hostname", "http://example.org/a", "file:///etc/hostname", "",
        "../../../../../../etc/hostname", "%2e%2e/secret", "a/../../b", "a.glb%00.bin"}) {
    write_split(folder / "a.glb", small_asset());
    const std::vector<std::uint8_t> whole = read_file(folder / "a.glb");
    const GlbChunks chunks = split_glb(whole);
    json root = json::parse(chunks.json);
    root["buffers"][1]["uri"] = uri;
    std::vector<std::uint8_t> bytes = glb_head(root.dump(), chunks.binary.size());
    bytes.insert(bytes.end(), chunks.binary.begin(), chunks.binary.end());
    exporter::write_file_atomically(folder / "a.glb", bytes);
    try {
      read_progressive(folder / "a.glb");
      FAIL() << uri << " was read";
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("/buffers/1/uri"), std::string::npos)
          << error.what();
    }
  }
}

TEST(DataUri, HoldsBuffersOfAGltfFile) {
  const TemporaryFolder folder;
  const ProgressiveAsset asset = small_asset();
  write_split(folder / "a.gltf", asset);
  json root = json::parse(read_file(folder / "a.gltf"));
  // Base64 of the payload, four letters per three bytes; kPayloadSize leaves one byte.
  const std::string letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < asset.payload.size(); i += 3) {
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k)
      bits = bits << 8 | (i + k < asset.payload.size() ? asset.payload[i + k] : 0u);
    for (int shift = 18; shift >= 0; shift -= 6) text += letters[bits >> shift & 63];
  }
  text.replace(text.size() - 2, 2, "==");
  root["buffers"][1]["uri"] = "data:application/octet-stream;base64," + text;
  exporter::write_file_atomically(folder / "b.gltf", root.dump());
  EXPECT_EQ(read_progressive(folder / "b.gltf").payload, asset.payload);
}

TEST(OrdinaryGltf, IsNamedAsSuch) {
  const TemporaryFolder folder;
  exporter::write_file_atomically(folder / "a.gltf", R"({"asset":{"version":"2.0"}})");
  try {
    read_progressive(folder / "a.gltf");
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("zerotree convert"), std::string::npos);
  }
  EXPECT_THROW(read_progressive(folder / "missing.glb"), Error);
  EXPECT_THROW(read_progressive(folder.path()), Error);
}

}  // namespace
}  // namespace zerotree::gltf
