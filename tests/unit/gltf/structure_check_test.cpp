// The check of the whole document: which defects it finds is compared with glTF-Validator by the
// interop tests; here it must be quiet on right files, and safe and quick on hostile ones.
#include "gltf/structure_check.h"

#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <nlohmann/json.hpp>
#include <random>
#include <set>

#include "export/atomic_file.h"
#include "gltf/glb_container.h"
#include "gltf/progressive_writer.h"
#include "sample_assets.h"

namespace zerotree::gltf {
namespace {

using nlohmann::json;
using Bytes = std::vector<std::uint8_t>;

// "CODE pointer" of each issue.
std::multiset<std::string> found_in(const Bytes& bytes) {
  Issues issues;
  try {
    GltfDocument document("a.glb", bytes, issues);
    check_structure(document, issues);
  } catch (const IssueFound& found) {
    issues.push_back(found.issue());
  }
  std::multiset<std::string> found;
  for (const Issue& issue : issues)
    found.insert(std::string(issue_text(issue.code).id) + " " + issue.pointer);
  return found;
}

using Found = std::multiset<std::string>;

Bytes with_json(const Bytes& whole, const std::function<void(json&)>& change) {
  const GlbChunks chunks = split_glb(whole);
  json root = json::parse(chunks.json);
  change(root);
  Bytes bytes = glb_head(root.dump(), chunks.binary.size());
  bytes.insert(bytes.end(), chunks.binary.begin(), chunks.binary.end());
  return bytes;
}

Bytes small_glb() {
  return glb_bytes(test::sample_asset({"tetrahedron", test::tetrahedron(), {}, {}}, 40));
}

Bytes small_compressed_glb() {
  return glb_bytes(test::grid_asset({"tetrahedron", test::tetrahedron(), {}, {}}, 40),
                   {.compress_base = true});
}

class EachWritten : public testing::TestWithParam<test::Shape> {};

TEST_P(EachWritten, WrittenFilesAreRight) {
  EXPECT_EQ(found_in(glb_bytes(test::sample_asset(GetParam(), 1001))), Found{});
  EXPECT_EQ(found_in(glb_bytes(test::grid_asset(GetParam(), 1001), {.compress_base = true})),
            Found{});
}

INSTANTIATE_TEST_SUITE_P(Shapes, EachWritten, testing::ValuesIn(test::base_shapes()),
                         [](const auto& shape) { return shape.param.name; });

TEST(StructureCheck, AllDefectsAreFoundAtOnce) {
  const Bytes bytes = with_json(small_glb(), [](json& root) {
    root["scene"] = 4;
    root["nodes"][0]["children"] = {0};
    root["accessors"][1]["min"][0] = -7;
    root["bufferViews"][2]["byteLength"] = 1 << 20;
    root["asset"]["author"] = "none";
  });
  EXPECT_EQ(found_in(bytes), (Found{
                                 "UNRESOLVED_REFERENCE /scene",
                                 "NODE_LOOP /nodes/0",
                                 "SCENE_NON_ROOT_NODE /scenes/0/nodes/0",
                                 "ACCESSOR_MIN_MISMATCH /accessors/1/min/0",
                                 "BUFFER_VIEW_TOO_LONG /bufferViews/2/byteLength",
                                 "UNEXPECTED_PROPERTY /asset/author",
                             }));
}

// The packed data is looked into, which glTF-Validator does not do.
TEST(StructureCheck, CompressedValuesAreCompared) {
  EXPECT_EQ(found_in(with_json(small_compressed_glb(),
                               [](json& root) { root["accessors"][1]["max"][2] = 9; })),
            (Found{"ACCESSOR_MAX_MISMATCH /accessors/1/max/2",
                   "ACCESSOR_ELEMENT_OUT_OF_MAX_BOUND /accessors/1/max/2"}));
}

TEST(StructureCheck, PaddedMatricesAreRead) {
  Bytes bytes = glb_head(R"({"asset":{"version":"2.0"},
    "accessors":[{"bufferView":0,"componentType":5121,"count":1,"type":"MAT2",
                  "min":[1,2,3,4],"max":[1,2,3,4]}],
    "bufferViews":[{"buffer":0,"byteLength":8}],"buffers":[{"byteLength":8}]})",
                         8);
  for (int value : {1, 2, 0, 0, 3, 4, 0, 0}) bytes.push_back(static_cast<std::uint8_t>(value));
  EXPECT_EQ(found_in(bytes), Found{});
  bytes[bytes.size() - 3] = 9;
  EXPECT_EQ(found_in(bytes), (Found{"ACCESSOR_MAX_MISMATCH /accessors/0/max/3",
                                    "ACCESSOR_ELEMENT_OUT_OF_MAX_BOUND /accessors/0/max/3",
                                    "ACCESSOR_MIN_MISMATCH /accessors/0/min/3"}));
}

TEST(HostileStructure, HugeCountsAreRefused) {
  for (double count : {5.0, 1e9, 4294967295.0, 9007199254740992.0, 1e300})
    EXPECT_TRUE(
        found_in(with_json(small_glb(), [&](json& root) { root["accessors"][1]["count"] = count; }))
            .contains("ACCESSOR_TOO_LONG /accessors/1"))
        << count;
}

void replace_each_value(const Bytes& whole) {
  const std::vector<json> replacements = {nullptr,
                                          true,
                                          -1,
                                          0,
                                          1,
                                          1e9,
                                          9007199254740992,
                                          1e300,
                                          "abc",
                                          json::array(),
                                          json::object(),
                                          json::parse("[[1]]"),
                                          -0.5};
  const json flat = json::parse(split_glb(whole).json).flatten();
  for (const auto& [pointer, value] : flat.items())
    for (const json& replacement : replacements) {
      const auto found = found_in(
          with_json(whole, [&](json& root) { root[json::json_pointer(pointer)] = replacement; }));
      for (auto issue = found.begin(); issue != found.end(); ++issue)
        ASSERT_EQ(found.count(*issue), 1u) << pointer << " = " << replacement << ": " << *issue;
    }
}

TEST(HostileStructure, EveryValueMayBeWrong) {
  replace_each_value(small_glb());
}

TEST(HostileStructure, EveryValueOfACompressedFileMayBeWrong) {
  replace_each_value(small_compressed_glb());
}

TEST(HostileStructure, EveryByteMayBeWrong) {
  std::mt19937 random(2);
  for (const Bytes& whole : {small_glb(), small_compressed_glb()})
    for (int round = 0; round < 4000; ++round) {
      Bytes bytes = whole;
      for (int k = 0; k < 3; ++k)
        bytes[random() % bytes.size()] = static_cast<std::uint8_t>(random());
      found_in(bytes);
    }
}

double seconds(const std::function<void()>& run) {
  const auto start = std::chrono::steady_clock::now();
  run();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// Ten times the size must take about ten times as long, not a hundred times: 25 leaves room for a
// machine that does other things.
void expect_linear(const std::function<Bytes(std::size_t)>& make, std::size_t size) {
  const Bytes small = make(size), large = make(10 * size);
  const double few = seconds([&] { found_in(small); }) + 0.02;
  EXPECT_LT(seconds([&] { found_in(large); }), 25 * few);
}

std::string repeated(std::size_t count, const std::function<std::string(std::size_t)>& element) {
  std::string text;
  for (std::size_t i = 0; i < count; ++i) text.append(i == 0 ? "" : ",").append(element(i));
  return text;
}

Bytes gltf_bytes(const std::string& members) {
  const std::string text = R"({"asset":{"version":"2.0"},)" + members + "}";
  return {text.begin(), text.end()};
}

TEST(HostileStructure, LongChainsOfNodesAreQuick) {
  expect_linear(
      [](std::size_t size) {
        return gltf_bytes("\"nodes\":[" +
                          repeated(size,
                                   [&](std::size_t i) {
                                     return "{\"children\":[" + std::to_string((i + 1) % size) +
                                            "]}";
                                   }) +
                          "]");
      },
      20000);
}

TEST(HostileStructure, ManyPrimitivesOfTheSameIndicesAreQuick) {
  expect_linear(
      [](std::size_t size) {
        return with_json(small_glb(), [&](json& root) {
          json& primitives = root["meshes"][0]["primitives"];
          primitives = json(size, primitives[0]);
        });
      },
      5000);
}

// Each accessor may name all bytes of the file; beyond a limit they are not looked at.
TEST(HostileStructure, ManyAccessorsOfTheSameBytesAreRefused) {
  constexpr std::size_t kLength = 4000000;
  const std::string accessor =
      "{\"bufferView\":0,\"componentType\":5121,\"type\":\"SCALAR\",\"count\":" +
      std::to_string(kLength) + "}";
  const std::string text = R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":4000000}],)"
                           R"("bufferViews":[{"buffer":0,"byteLength":4000000}],"accessors":[)" +
                           repeated(5000, [&](std::size_t) { return accessor; }) + "]}";
  Bytes bytes = glb_head(text, kLength);
  bytes.resize(bytes.size() + kLength);
  Found found;
  EXPECT_LT(seconds([&] { found = found_in(bytes); }), 10);
  EXPECT_EQ(found.count("ACCESSOR_DATA_UNCHECKED /accessors/4999"), 1u);
  EXPECT_EQ(found.count("ACCESSOR_DATA_UNCHECKED /accessors/9"), 0u);
}

// Buffers that name the same file share its bytes.
TEST(HostileStructure, ManyBuffersOfTheSameFileTakeItsMemoryOnce) {
  const test::TemporaryFolder folder;
  exporter::write_file_atomically(folder / "a.bin", Bytes(50000000));
  const Bytes bytes =
      gltf_bytes("\"buffers\":[" +
                 repeated(2000,
                          [](std::size_t i) {
                            return std::string(R"({"byteLength":50000000,"uri":")") +
                                   (i % 2 == 0 ? "" : "./") + "a.bin\"}";
                          }) +
                 "]");
  Issues issues;
  GltfDocument document(folder / "a.gltf", bytes, issues);
  check_structure(document, issues);
  EXPECT_TRUE(issues.empty());
}

}  // namespace
}  // namespace zerotree::gltf
