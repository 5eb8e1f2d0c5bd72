#include "validate/file_validation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <nlohmann/json.hpp>
#include <random>

#include "changed_files.h"
#include "encoded_assets.h"
#include "export/atomic_file.h"
#include "gltf/glb_container.h"
#include "gltf/progressive_writer.h"
#include "mesh/error.h"
#include "sample_assets.h"

namespace zerotree::validate {
namespace {

using nlohmann::json;
using test::codes;
using test::extension;
using test::TemporaryFolder;
using test::validate_bytes;
using test::with_json;

constexpr const char* kExtensionPointer = "/meshes/0/extensions/ZEROTREE_mesh_progressive";

class EachShape : public testing::TestWithParam<test::Shape> {};

TEST_P(EachShape, RightFilesHaveNoIssue) {
  const gltf::ProgressiveAsset asset = test::encoded_asset(GetParam());
  const ValidationReport report = validate_bytes(gltf::glb_bytes(asset));
  EXPECT_EQ(codes(report), std::vector<std::string>{});
  ASSERT_EQ(report.meshes.size(), 1u);
  EXPECT_EQ(report.meshes[0].levels, 2);
  EXPECT_EQ(report.meshes[0].base_vertices, asset.base.vertex_count);
  EXPECT_EQ(report.meshes[0].payload_bytes, asset.payload.size());
  EXPECT_GT(report.meshes[0].finest_vertices, asset.base.vertex_count);
}

TEST_P(EachShape, RightSplitFilesHaveNoIssue) {
  const TemporaryFolder folder;
  gltf::write_split(folder / "a.gltf", test::encoded_asset(GetParam()));
  const ValidationReport report = validate_file(folder / "a.gltf");
  EXPECT_EQ(codes(report), std::vector<std::string>{});
  EXPECT_EQ(report.mime_type, "model/gltf+json");
}

TEST_P(EachShape, RightCompressedFilesHaveNoIssue) {
  const gltf::ProgressiveAsset asset = test::encoded_grid_asset(GetParam());
  const ValidationReport report = validate_bytes(gltf::glb_bytes(asset, {.compress_base = true}));
  EXPECT_EQ(codes(report), std::vector<std::string>{});
  ASSERT_EQ(report.meshes.size(), 1u);
  EXPECT_EQ(report.meshes[0].base_vertices, asset.base.vertex_count);
}

TEST_P(EachShape, RightStreamsHaveNoIssue) {
  const auto stream = test::encoded_stream(GetParam());
  const ValidationReport report = validate_bytes(stream, "a.zt");
  EXPECT_EQ(codes(report), std::vector<std::string>{});
  ASSERT_EQ(report.meshes.size(), 1u);
  EXPECT_EQ(report.meshes[0].base_vertices, GetParam().mesh.positions.size());
}

INSTANTIATE_TEST_SUITE_P(Shapes, EachShape, testing::ValuesIn(test::base_shapes()),
                         [](const auto& shape) { return shape.param.name; });

struct BrokenVariant {
  const char* code;
  const char* pointer;
  std::function<void(json&)> change;
};

// clang-format off
const std::vector<BrokenVariant>& broken_variants() {
  static const std::vector<BrokenVariant> variants = {
      {"UNDECLARED_EXTENSION", "/extensions/ZEROTREE_mesh_progressive", [](json& r) { r.erase("extensionsUsed"); }},
      {"EXTENSION_REQUIRED", "/extensionsRequired",
       [](json& r) { r["extensionsRequired"] = {gltf::kExtensionName}; }},
      {"EXTENSION_MISPLACED", "/bufferViews/0/extensions/ZEROTREE_mesh_progressive",
       [](json& r) { r["bufferViews"][0]["extensions"][gltf::kExtensionName] = json::object(); }},
      {"UNDEFINED_PROPERTY", kExtensionPointer, [](json& r) { extension(r).erase("prefixes"); }},
      {"TYPE_MISMATCH", "/levels", [](json& r) { extension(r)["levels"] = "two"; }},
      {"VALUE_NOT_IN_RANGE", "/levels", [](json& r) { extension(r)["levels"] = 15; }},
      {"VALUE_NOT_IN_RANGE", "/bounds", [](json& r) { extension(r)["bounds"]["min"][1] = 99; }},
      {"UNEXPECTED_PROPERTY", "/levles", [](json& r) { extension(r)["levles"] = 2; }},
      {"UNRESOLVED_REFERENCE", "/bufferView", [](json& r) { extension(r)["bufferView"] = 77; }},
      {"PREFIX_ORDER", "/prefixes/2/byteLength",
       [](json& r) { extension(r)["prefixes"][2]["byteLength"] = 1; }},
      {"PREFIX_ORDER", "/prefixes/3/geometricError",
       [](json& r) { extension(r)["prefixes"][3]["geometricError"] = 9.5; }},
      {"PREFIX_END", "/prefixes", [](json& r) { extension(r)["prefixes"].erase(4); }},
      {"IO_ERROR", "/buffers/0/uri", [](json& r) { r["buffers"][0]["uri"] = "gone.bin"; }},
      {"BUFFER_VIEW_TOO_LONG", "/bufferViews/2/byteLength",
       [](json& r) { r["bufferViews"][2]["byteLength"] = 1 << 20; }},
      {"ACCESSOR_TOO_LONG", "/accessors/1", [](json& r) { r["accessors"][1]["count"] = 1000; }},
      {"ACCESSOR_UNSUPPORTED", "/accessors/1", [](json& r) { r["accessors"][1]["type"] = "VEC2"; }},
      {"BASE_UNSUPPORTED", "/meshes/0/primitives/0/mode",
       [](json& r) { r["meshes"][0]["primitives"][0]["mode"] = 5; }},
      {"ACCESSOR_INDEX_OOB", "/meshes/0/primitives/0/indices",
       [](json& r) { r["accessors"][1]["count"] = 3; r["accessors"][2]["count"] = 3; }},
      {"PAYLOAD_VIEW_INVALID", "/bufferViews/2",
       [](json& r) { r["bufferViews"][2]["target"] = 34962; }},
      {"PAYLOAD_NOT_LAST", "/bufferViews/2",
       [](json& r) { r["bufferViews"][2]["byteLength"] = 8; }},
      {"PAYLOAD_LEVELS_MISMATCH", "/levels", [](json& r) { extension(r)["levels"] = 1; }},
      {"PAYLOAD_TOO_LARGE", "/levels", [](json& r) { extension(r)["levels"] = 14; }},
      {"SURFACE_OUT_OF_BOUNDS", "/prefixes/4",
       [](json& r) { extension(r)["bounds"]["max"][0] = 0.1; }},
      {"UNKNOWN_ASSET_MAJOR_VERSION", "/asset/version", [](json& r) { r["asset"]["version"] = "1.0"; }},
  };
  return variants;
}
// clang-format on

TEST(BrokenFile, EachDefectHasItsCodeAndPlace) {
  for (const BrokenVariant& variant : broken_variants()) {
    const ValidationReport report = validate_bytes(with_json(variant.change));
    const bool is_found =
        std::any_of(report.issues.begin(), report.issues.end(), [&](const gltf::Issue& issue) {
          return std::string(gltf::issue_text(issue.code).id) == variant.code &&
                 issue.pointer.ends_with(variant.pointer);
        });
    EXPECT_TRUE(is_found) << variant.code << " at " << variant.pointer << " is not in "
                          << to_json(report)["issues"].dump(1);
  }
}

TEST(BrokenFile, AnotherBaseIsNamed) {
  gltf::ProgressiveAsset asset = test::encoded_asset(test::base_shapes()[0]);
  asset.control_points[5].x() += 0.001f;
  const ValidationReport report = validate_bytes(gltf::glb_bytes(asset));
  EXPECT_EQ(codes(report), std::vector<std::string>{"PAYLOAD_BASE_MISMATCH"});
}

// The packing extension's usual encoder turns triangles; their details belong to other corners
// then.
TEST(BrokenFile, ATurnedTriangleIsNamed) {
  gltf::ProgressiveAsset asset =
      test::encoded_grid_asset({"sphere", test::in_canonical_order(test::sphere(2)), {}, {}});
  auto& triangle = asset.base.triangles[3];
  std::rotate(triangle.begin(), triangle.begin() + 1, triangle.end());
  const auto bytes = gltf::glb_bytes(asset, {.compress_base = true});
  EXPECT_EQ(codes(validate_bytes(bytes)), std::vector<std::string>{"PAYLOAD_BASE_MISMATCH"});
}

TEST(BrokenFile, BrokenPackingIsNamed) {
  const auto asset =
      test::encoded_grid_asset({"sphere", test::in_canonical_order(test::sphere(2)), {}, {}});
  auto bytes = gltf::glb_bytes(asset, {.compress_base = true});
  const std::size_t binary = bytes.size() - gltf::split_glb(bytes).binary.size();
  bytes[binary] ^= 0x80;  // the header of the vertices' packed data
  EXPECT_EQ(codes(validate_bytes(bytes)), std::vector<std::string>{"PACKING_BROKEN"});
}

TEST(BrokenFile, ABrokenPayloadIsNamed) {
  gltf::ProgressiveAsset asset = test::encoded_asset(test::base_shapes()[0]);
  asset.payload[0] ^= 1;
  const ValidationReport report = validate_bytes(gltf::glb_bytes(asset));
  EXPECT_EQ(codes(report), std::vector<std::string>{"PAYLOAD_BROKEN"});
}

TEST(BrokenFile, ASurfaceBeyondFloatsIsNamed) {
  const auto asset = test::encoded_asset(test::base_shapes()[0], 1e41);
  const std::vector<std::string> found = codes(validate_bytes(gltf::glb_bytes(asset)));
  EXPECT_NE(std::find(found.begin(), found.end(), "SURFACE_NOT_FINITE"), found.end());
}

TEST(BrokenFile, ABaseThatIsNoManifoldIsNamed) {
  gltf::ProgressiveAsset asset = test::encoded_asset(test::base_shapes()[0]);
  std::swap(asset.base.triangles[0][0], asset.base.triangles[0][1]);
  const ValidationReport report = validate_bytes(gltf::glb_bytes(asset));
  EXPECT_EQ(codes(report), std::vector<std::string>{"BASE_UNSUPPORTED"});
}

TEST(BrokenFile, ACutIsNamedAndWhatIsThereDecodes) {
  auto bytes = gltf::glb_bytes(test::encoded_asset(test::base_shapes()[0]));
  bytes.resize(bytes.size() - 16);
  const ValidationReport report = validate_bytes(bytes);
  EXPECT_EQ(codes(report), (std::vector<std::string>{"GLB_UNEXPECTED_END_OF_CHUNK_DATA",
                                                     "PAYLOAD_TRUNCATED", "PAYLOAD_INCOMPLETE"}));
}

TEST(BrokenFile, UnknownBytesAreNamed) {
  const std::string text = "solid cube";
  EXPECT_EQ(codes(validate_bytes(std::vector<std::uint8_t>(text.begin(), text.end()))),
            std::vector<std::string>{"FILE_FORMAT_UNKNOWN"});
  EXPECT_EQ(codes(validate_bytes({})), std::vector<std::string>{"FILE_FORMAT_UNKNOWN"});
  const std::string brace = "{\"asset\":";
  EXPECT_EQ(codes(validate_bytes(std::vector<std::uint8_t>(brace.begin(), brace.end()))),
            std::vector<std::string>{"INVALID_JSON"});
}

TEST(CutStream, IsInformation) {
  auto stream = test::encoded_stream(test::base_shapes()[0]);
  stream.resize(stream.size() / 2);
  const ValidationReport report = validate_bytes(stream, "a.zt");
  EXPECT_EQ(codes(report), std::vector<std::string>{"PAYLOAD_INCOMPLETE"});
  EXPECT_EQ(count_issues(report, gltf::Severity::error), 0u);
}

// Most corruptions decode to another surface, those of the header are refused; none crashes.
TEST(CorruptedPayload, AnyByteMayBeWrong) {
  const gltf::ProgressiveAsset asset = test::encoded_asset({"t", test::tetrahedron(), {}, {}});
  std::mt19937 random(3);
  std::size_t refused = 0;
  for (std::size_t i = 0; i < asset.payload.size(); ++i) {
    gltf::ProgressiveAsset broken = asset;
    broken.payload[i] = static_cast<std::uint8_t>(broken.payload[i] ^ (1 + random() % 255));
    for (const std::string& code : codes(validate_bytes(gltf::glb_bytes(broken)))) {
      EXPECT_TRUE(code.starts_with("PAYLOAD_") || code.starts_with("SURFACE_")) << code;
      refused += code == "PAYLOAD_BROKEN" || code == "PAYLOAD_BASE_MISMATCH";
    }
  }
  EXPECT_GE(refused, 8u);  // at least every byte of the base's hash
}

TEST(OrdinaryGltf, IsRight) {
  const std::string text = R"({"asset":{"version":"2.0","generator":"someone"}})";
  const ValidationReport report =
      validate_bytes(std::vector<std::uint8_t>(text.begin(), text.end()), "a.gltf");
  EXPECT_EQ(codes(report), std::vector<std::string>{"EXTENSION_ABSENT"});
  EXPECT_EQ(count_issues(report, gltf::Severity::error), 0u);
  EXPECT_EQ(report.generator, "someone");
}

TEST(MissingFile, CannotBeValidated) {
  EXPECT_THROW(validate_file("no/such/file.glb"), Error);
}

TEST(Report, HasTheShapeOfGltfValidators) {
  const json report = to_json(validate_bytes(with_json([](json& r) { extension(r)["x"] = 1; })));
  EXPECT_EQ(report["mimeType"], "model/gltf-binary");
  EXPECT_TRUE(report["uri"].is_string() && report["validatorVersion"].is_string());
  EXPECT_EQ(report["issues"]["numErrors"], 0);
  EXPECT_EQ(report["issues"]["numWarnings"], 1);
  const json& message = report["issues"]["messages"][0];
  EXPECT_EQ(message["code"], "UNEXPECTED_PROPERTY");
  EXPECT_EQ(message["severity"], 1);
  EXPECT_EQ(message["pointer"], std::string(kExtensionPointer) + "/x");
  EXPECT_TRUE(message["message"].is_string());
  EXPECT_EQ(report["info"]["extensionsUsed"], json({gltf::kExtensionName}));
}

TEST(Report, LeavesOutWhatIsNotKnown) {
  const std::string text = "no glTF";
  for (const ValidationReport& report :
       {validate_bytes(std::vector<std::uint8_t>(text.begin(), text.end())),
        unreadable_report("a.glb", "it is not there")}) {
    const json shown = to_json(report);
    EXPECT_FALSE(shown.contains("mimeType")) << shown;
    EXPECT_FALSE(shown.contains("info")) << shown;
    EXPECT_EQ(shown["issues"]["numErrors"], 1) << shown;
  }
}

}  // namespace
}  // namespace zerotree::validate
