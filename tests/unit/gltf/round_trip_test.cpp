#include <gtest/gtest.h>
#include <tiny_gltf.h>

#include "asset_equality.h"
#include "gltf/gltf_document.h"
#include "gltf/progressive_reader.h"
#include "gltf/progressive_writer.h"
#include "mesh/error.h"
#include "sample_assets.h"

namespace zerotree::gltf {

namespace {

using test::expect_equal;
using test::TemporaryFolder;

class EachShape : public testing::TestWithParam<test::Shape> {};

TEST_P(EachShape, GlbRoundTrip) {
  const TemporaryFolder folder;
  const ProgressiveAsset asset = test::sample_asset(GetParam(), 333);
  write_glb(folder / "a.glb", asset);
  expect_equal(read_progressive(folder / "a.glb"), asset);
  EXPECT_EQ(folder.file_names(), std::vector<std::string>{"a.glb"});
}

TEST_P(EachShape, SplitRoundTrip) {
  const TemporaryFolder folder;
  const ProgressiveAsset asset = test::sample_asset(GetParam(), 333);
  write_split(folder / "with space.glb", asset);
  EXPECT_EQ(folder.file_names(), (std::vector<std::string>{"with space.glb", "with space.zt.bin"}));
  expect_equal(read_progressive(folder / "with space.glb"), asset);
  write_split(folder / "b.gltf", asset);
  expect_equal(read_progressive(folder / "b.gltf"), asset);
}

// An unaware reader, of an independent code base, sees the base mesh.
TEST_P(EachShape, TinygltfReadsTheBase) {
  const TemporaryFolder folder;
  const ProgressiveAsset asset = test::sample_asset(GetParam(), 333);
  write_glb(folder / "a.glb", asset);
  tinygltf::Model model;
  std::string error, warning;
  ASSERT_TRUE(tinygltf::TinyGLTF().LoadBinaryFromFile(&model, &error, &warning,
                                                      (folder / "a.glb").string()))
      << error;
  const tinygltf::Primitive& primitive = model.meshes.at(0).primitives.at(0);
  const auto accessor = [&](int index) { return model.accessors.at(std::size_t(index)); };
  EXPECT_EQ(accessor(primitive.attributes.at("POSITION")).count, asset.control_points.size());
  EXPECT_EQ(accessor(primitive.attributes.at("NORMAL")).count, asset.normals.size());
  EXPECT_EQ(accessor(primitive.indices).count, asset.base.triangles.size() * 3);
  EXPECT_EQ(model.extensionsUsed, std::vector<std::string>{kExtensionName});
  EXPECT_TRUE(model.extensionsRequired.empty());
}

INSTANTIATE_TEST_SUITE_P(Shapes, EachShape, testing::ValuesIn(test::base_shapes()),
                         [](const auto& shape) { return shape.param.name; });

int index_type_of(const TriangleMesh& mesh) {
  const auto bytes = glb_bytes(test::sample_asset({"mesh", mesh, {}, {}}, 9));
  const GltfDocument document("mesh.glb", bytes);
  return static_cast<int>(
      document.root().member("accessors").element(0).member("componentType").unsigned_integer());
}

TEST(Writer, IndicesHaveTheSmallestType) {
  EXPECT_EQ(index_type_of(test::grid(4, 50)), 5121);     // 255 vertices
  EXPECT_EQ(index_type_of(test::grid(7, 31)), 5123);     // 256 vertices
  EXPECT_EQ(index_type_of(test::grid(255, 255)), 5125);  // 65536 vertices
}

TEST(Writer, NormalsAreOptional) {
  const TemporaryFolder folder;
  ProgressiveAsset asset = test::sample_asset(test::base_shapes()[0], 100);
  asset.normals.clear();
  write_glb(folder / "a.glb", asset);
  expect_equal(read_progressive(folder / "a.glb"), asset);
}

// Beside payload, positions and indices: about what a base of 112 vertices takes for one of them.
TEST(Writer, SpendsFewBytesOnTheRest) {
  for (const test::Shape& shape : test::base_shapes()) {
    ProgressiveAsset asset = test::sample_asset(shape, 1000);
    asset.normals.clear();
    const std::size_t data =
        1000 + 12 * asset.control_points.size() + 3 * asset.base.triangles.size();
    EXPECT_LE(glb_bytes(asset).size(), data + 1100) << shape.name;
  }
}

TEST(Writer, SplitSizeIsThatOfAllFiles) {
  const ProgressiveAsset asset = test::sample_asset(test::base_shapes()[0], 101);
  for (const char* name : {"a.glb", "a.gltf"}) {
    const TemporaryFolder folder;
    write_split(folder / name, asset);
    std::uint64_t size = 0;
    for (const std::string& file : folder.file_names())
      size += std::filesystem::file_size(folder / file);
    EXPECT_EQ(split_size(folder / name, asset), size) << name;
  }
}

TEST(Writer, LargeBasesRoundTrip) {
  const TemporaryFolder folder;
  for (int side : {15, 255}) {
    const auto asset = test::sample_asset({"grid", test::grid(side, side), {}, {}}, 100);
    write_glb(folder / "grid.glb", asset);
    expect_equal(read_progressive(folder / "grid.glb"), asset);
  }
}

TEST(Writer, OnlyOpenSurfacesAreDoubleSided) {
  for (const test::Shape& shape : test::base_shapes()) {
    const GltfDocument document("x.glb", glb_bytes(test::sample_asset(shape, 9)));
    const bool is_open = shape.name == "grid" || shape.name == "two_components";
    EXPECT_EQ(document.root().member("materials").element(0).member("doubleSided").exists(),
              is_open)
        << shape.name;
  }
}

TEST(Writer, PayloadIsTheEndOfTheFile) {
  const auto asset = test::sample_asset(test::base_shapes()[0], 332);
  const std::vector<std::uint8_t> bytes = glb_bytes(asset);
  EXPECT_TRUE(std::equal(asset.payload.rbegin(), asset.payload.rend(), bytes.rbegin()));
}

TEST(Writer, SameAssetGivesSameBytes) {
  const auto asset = test::sample_asset(test::base_shapes()[2], 400);
  EXPECT_EQ(glb_bytes(asset), glb_bytes(asset));
}

TEST(Writer, RefusesBrokenAssets) {
  const ProgressiveAsset good = test::sample_asset(test::base_shapes()[0], 100);
  const auto refuses = [&](auto break_it) {
    ProgressiveAsset bad = good;
    break_it(bad);
    EXPECT_THROW(glb_bytes(bad), Error);
  };
  refuses([](auto& a) { a.payload.clear(); });
  refuses([](auto& a) { a.normals.pop_back(); });
  refuses([](auto& a) { a.base.triangles[3][1] = a.base.vertex_count; });
  refuses([](auto& a) { a.control_points[2].y() = std::numeric_limits<float>::quiet_NaN(); });
  refuses([](auto& a) { a.prefixes.back().byte_length = 99; });
  refuses([](auto& a) { a.prefixes[1].geometric_error = 0.5; });
  refuses([](auto& a) { a.levels = kMaxLevels + 1; });
  refuses([](auto& a) { std::swap(a.bounds_min, a.bounds_max); });
  refuses([](auto& a) { a.source_diagonal = 0; });
}

// What the writer writes is what the specification's schema describes.
TEST(Schema, KnowsAndRequiresWhatIsWritten) {
  const auto bytes =
      read_file(ZEROTREE_SPEC_DIR "/schema/mesh.ZEROTREE_mesh_progressive.schema.json");
  const auto schema = nlohmann::json::parse(bytes);
  const GltfDocument document("x.glb", glb_bytes(test::sample_asset(test::base_shapes()[0], 9)));
  const nlohmann::json& extension = document.root()
                                        .member("meshes")
                                        .element(0)
                                        .member("extensions")
                                        .member(kExtensionName)
                                        .value();
  for (const auto& [key, value] : extension.items())
    EXPECT_TRUE(schema["properties"].contains(key)) << key;
  for (const auto& key : schema["required"]) EXPECT_TRUE(extension.contains(key)) << key;
  EXPECT_EQ(schema["properties"]["levels"]["maximum"], kMaxLevels);
}

TEST(MonotonePrefixes, SortsAndNeverUnderstates) {
  const auto table = monotone_prefixes({{400, 0.2}, {0, 1.0}, {100, 0.1}, {200, 0.5}, {200, 0.4}});
  ASSERT_EQ(table.size(), 4u);
  const std::vector<double> errors = {1.0, 0.5, 0.5, 0.2};
  const std::vector<std::uint64_t> lengths = {0, 100, 200, 400};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(table[i].byte_length, lengths[i]);
    EXPECT_EQ(table[i].geometric_error, errors[i]);
  }
}

}  // namespace
}  // namespace zerotree::gltf
