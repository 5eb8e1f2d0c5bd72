#include "validate/budget_check.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "changed_files.h"
#include "encoded_assets.h"
#include "export/atomic_file.h"
#include "gltf/progressive_writer.h"
#include "sample_assets.h"

namespace zerotree::validate {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::codes;
using test::encoded_asset;
using test::issue_with;
using test::TemporaryFolder;
using test::validate_bytes;
using test::with_json;
using Codes = std::vector<std::string>;

ValidateOptions with_budgets(const Budgets& budgets) {
  ValidateOptions options;
  options.budgets = budgets;
  return options;
}

const test::Shape& shape() {
  static const test::Shape shape = test::base_shapes()[0];
  return shape;
}

TEST(BytesBudget, CountsAFileAndNoMore) {
  const auto bytes = gltf::glb_bytes(encoded_asset(shape()));
  const auto allowed = [&](std::uint64_t size) {
    return validate_bytes(bytes, "a.glb", with_budgets({.max_bytes = size}));
  };
  EXPECT_EQ(codes(allowed(bytes.size())), Codes{});
  EXPECT_EQ(allowed(bytes.size()).total_bytes, bytes.size());
  const ValidationReport report = allowed(bytes.size() - 1);
  ASSERT_EQ(codes(report), Codes{"BUDGET_BYTES"});
  EXPECT_EQ(report.issues[0].detail, std::to_string(bytes.size()) + " bytes, allowed are " +
                                         std::to_string(bytes.size() - 1));
  const auto stream = test::encoded_stream(shape());
  EXPECT_EQ(codes(validate_bytes(stream, "a.zt", with_budgets({.max_bytes = stream.size()}))),
            Codes{});
  EXPECT_EQ(codes(validate_bytes(stream, "a.zt", with_budgets({.max_bytes = 10}))),
            Codes{"BUDGET_BYTES"});
}

TEST(BytesBudget, CountsNamedFilesOnce) {
  const TemporaryFolder folder;
  gltf::write_split(folder / "a.gltf", encoded_asset(shape()));
  std::uint64_t bytes = 0;
  for (const std::string& name : folder.file_names()) bytes += fs::file_size(folder / name);
  EXPECT_GT(folder.file_names().size(), 1u);
  const auto total = [&] {
    return validate_file(folder / "a.gltf", with_budgets({.max_bytes = 1})).total_bytes;
  };
  EXPECT_EQ(total(), bytes);

  const auto old_size = fs::file_size(folder / "a.gltf");
  json root = json::parse(std::ifstream(folder / "a.gltf"));
  root["images"] = {{{"uri", "a%20b.png"}},
                    {{"uri", "./a%20b.png"}},
                    {{"uri", "data:image/png;base64,AAAA"}},
                    {{"bufferView", 0}, {"mimeType", "image/png"}}};
  std::ofstream(folder / "a.gltf") << root;
  std::ofstream(folder / "a b.png") << "1234567";
  EXPECT_EQ(total(), bytes - old_size + fs::file_size(folder / "a.gltf") + 7);
}

TEST(BytesBudget, NamesFilesThatCannotBeCounted) {
  for (const char* uri : {"gone.png", "https://example.org/a.png"}) {
    const auto bytes = with_json([&](json& root) { root["images"] = {{{"uri", uri}}}; });
    const ValidationReport report =
        validate_bytes(bytes, "a.glb", with_budgets({.max_bytes = 1'000'000}));
    ASSERT_EQ(codes(report), Codes{"IO_ERROR"}) << uri;
    EXPECT_EQ(report.issues[0].pointer, "/images/0/uri");
    EXPECT_EQ(codes(validate_bytes(bytes)), Codes{}) << "nobody asked for its size";
  }
}

TEST(TriangleBudget, CountsTheFinestSurfacesOfAllMeshes) {
  const auto asset = encoded_asset(shape());
  const std::uint64_t triangles = 16 * asset.base.triangles.size();
  const auto two =
      with_json(asset, [](json& root) { root["meshes"].push_back(root["meshes"][0]); });
  EXPECT_EQ(codes(validate_bytes(two, "a.glb", with_budgets({.max_triangles = 2 * triangles}))),
            Codes{});
  const ValidationReport report =
      validate_bytes(two, "a.glb", with_budgets({.max_triangles = 2 * triangles - 1}));
  ASSERT_EQ(codes(report), Codes{"BUDGET_TRIANGLES"});
  EXPECT_EQ(report.issues[0].detail, std::to_string(2 * triangles) + " triangles, allowed are " +
                                         std::to_string(2 * triangles - 1));
}

TEST(ErrorBudget, IsForTheLastEntryOfTheTable) {
  auto asset = encoded_asset(shape());
  asset.source_diagonal = 2;
  asset.prefixes.back().geometric_error = 0.002;
  const auto bytes = gltf::glb_bytes(asset);
  const auto allowed = [&](double error) {
    return validate_bytes(bytes, "a.glb", with_budgets({.max_error = error}));
  };
  EXPECT_EQ(codes(allowed(0.001)), Codes{});
  const ValidationReport report = allowed(0.00099);
  ASSERT_EQ(codes(report), Codes{"BUDGET_ERROR"});
  EXPECT_EQ(report.issues[0].pointer,
            "/meshes/0/extensions/ZEROTREE_mesh_progressive/prefixes/4/geometricError");
  EXPECT_EQ(report.issues[0].detail, "0.001, allowed is 0.00099");
}

TEST(ErrorBudget, InMetresIsForTheMeshInItsPlace) {
  auto asset = test::encoded_grid_asset(shape());
  for (gltf::PrefixEntry& entry : asset.prefixes)
    entry.geometric_error = 0.004 / asset.placement.scale;
  const auto bytes = gltf::glb_bytes(asset, {.compress_base = true});
  EXPECT_EQ(codes(validate_bytes(bytes, "a.glb", with_budgets({.max_error_metres = 0.004}))),
            Codes{});
  const ValidationReport report =
      validate_bytes(bytes, "a.glb", with_budgets({.max_error_metres = 0.0039}));
  ASSERT_EQ(codes(report), Codes{"BUDGET_ERROR"});
  EXPECT_EQ(report.issues[0].detail, "0.004 m, allowed is 0.0039 m");
}

TEST(ErrorBudget, CannotBeKeptWithoutATable) {
  const auto stream = test::encoded_stream(shape());
  EXPECT_EQ(codes(validate_bytes(stream, "a.zt", with_budgets({.max_error = 1}))),
            Codes{"BUDGET_ERROR_UNKNOWN"});
  // An ordinary file has lost nothing.
  const std::string text = R"({"asset":{"version":"2.0"}})";
  EXPECT_EQ(codes(validate_bytes(std::vector<std::uint8_t>(text.begin(), text.end()), "a.gltf",
                                 with_budgets({.max_error = 1, .max_triangles = 1}))),
            Codes{"EXTENSION_ABSENT"});
}

}  // namespace
}  // namespace zerotree::validate
