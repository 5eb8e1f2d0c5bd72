#include <gtest/gtest.h>

#include <limits>

#include "asset_equality.h"
#include "gltf/base_layout.h"
#include "gltf/gltf_document.h"
#include "gltf/packed_view.h"
#include "gltf/progressive_reader.h"
#include "gltf/progressive_writer.h"
#include "sample_assets.h"

namespace zerotree::gltf {
namespace {

using test::expect_equal;
using test::TemporaryFolder;

constexpr WriteOptions kCompressed{.compress_base = true};

ProgressiveAsset large_asset(bool with_normals = true) {
  ProgressiveAsset asset =
      test::grid_asset({"sphere", test::in_canonical_order(test::sphere(2)), {}, {}}, 333);
  if (!with_normals) asset.normals.clear();
  return asset;
}

std::vector<std::string> strings(const JsonCursor& list) {
  std::vector<std::string> values;
  for (std::size_t i = 0; i < list.size(); ++i) values.push_back(list.element(i).string());
  return values;
}

std::vector<std::string> required_extensions(const ProgressiveAsset& asset) {
  const GltfDocument document("a.glb", glb_bytes(asset, kCompressed));
  const auto required = strings(document.root().member("extensionsRequired"));
  const auto used = strings(document.root().member("extensionsUsed"));
  EXPECT_EQ(used.size(), required.size() + 1);
  for (const std::string& name : required)
    EXPECT_NE(std::find(used.begin(), used.end(), name), used.end()) << name;
  return required;
}

class EachCompressed : public testing::TestWithParam<test::Shape> {};

TEST_P(EachCompressed, RoundTrips) {
  const TemporaryFolder folder;
  ProgressiveAsset asset = test::grid_asset(GetParam(), 333);
  for (int round = 0; round < 2; ++round) {
    write_glb(folder / "a.glb", asset, kCompressed);
    expect_equal(read_progressive(folder / "a.glb"), asset);
    write_split(folder / "b.glb", asset, kCompressed);
    expect_equal(read_progressive(folder / "b.glb"), asset);
    write_split(folder / "c.gltf", asset, kCompressed);
    expect_equal(read_progressive(folder / "c.gltf"), asset);
    asset.normals.clear();
  }
}

TEST_P(EachCompressed, IsNeverLarger) {
  const ProgressiveAsset asset = test::grid_asset(GetParam(), 333);
  EXPECT_LE(glb_bytes(asset, kCompressed).size(), glb_bytes(asset).size());
}

INSTANTIATE_TEST_SUITE_P(Shapes, EachCompressed, testing::ValuesIn(test::base_shapes()),
                         [](const auto& shape) { return shape.param.name; });

TEST(CompressedBase, LargeOnesRoundTrip) {
  const TemporaryFolder folder;
  for (const TriangleMesh& mesh : {test::sphere(2), test::sphere(3), test::sphere(4)}) {
    const ProgressiveAsset asset = test::grid_asset({"sphere", mesh, {}, {}}, 100);
    write_glb(folder / "a.glb", asset, kCompressed);
    expect_equal(read_progressive(folder / "a.glb"), asset);
  }
}

TEST(CompressedBase, RequiresWhatItUses) {
  EXPECT_EQ(required_extensions(large_asset()),
            (std::vector<std::string>{kQuantisationExtension, kPackingExtension}));
}

// Four vertices take fewer bytes than the words that would compress them.
TEST(CompressedBase, TinyOnesStayPlain) {
  const auto asset = test::grid_asset({"tetrahedron", test::tetrahedron(), {}, {}}, 9);
  EXPECT_TRUE(required_extensions(asset).empty());
}

TEST(CompressedBase, OnlyGridsAreQuantised) {
  const auto is_quantised = [](float x) {
    ProgressiveAsset asset = large_asset();
    asset.control_points[7].x() = x;
    const auto required = required_extensions(asset);
    return std::find(required.begin(), required.end(), kQuantisationExtension) != required.end();
  };
  EXPECT_TRUE(is_quantised(0));
  EXPECT_TRUE(is_quantised(65535));
  EXPECT_FALSE(is_quantised(65536));
  EXPECT_FALSE(is_quantised(-1));
  EXPECT_FALSE(is_quantised(-0.0f));
  EXPECT_FALSE(is_quantised(1.5f));
}

// 162 vertices: 6 bytes each and 4/3 a triangle, where the plain form takes 12 and 3.
TEST(CompressedBase, TakesFewBytes) {
  const ProgressiveAsset asset = large_asset(false);
  const std::size_t plain = glb_bytes(asset).size() - asset.payload.size();
  const std::size_t compressed = glb_bytes(asset, kCompressed).size() - asset.payload.size();
  EXPECT_LT(plain, 12 * 162 + 3 * 320 + 1120u);
  EXPECT_LT(compressed, 6 * 162 + 320 * 4 / 3 + 1650u);
}

TEST(CompressedBase, NormalsAreRounded) {
  const TemporaryFolder folder;
  ProgressiveAsset asset = large_asset();
  asset.normals =
      test::sample_asset({"sphere", test::in_canonical_order(test::sphere(2)), {}, {}}, 9).normals;
  write_glb(folder / "a.glb", asset, kCompressed);
  const ProgressiveAsset read = read_progressive(folder / "a.glb");
  for (std::size_t v = 0; v < asset.normals.size(); ++v)
    EXPECT_LT((read.normals[v] - asset.normals[v]).norm(), 0.01f);
}

TEST(CompressedBase, SameAssetGivesSameBytes) {
  EXPECT_EQ(glb_bytes(large_asset(), kCompressed), glb_bytes(large_asset(), kCompressed));
}

TEST(Placement, IsThatOfTheFirstNode) {
  const TemporaryFolder folder;
  ProgressiveAsset asset = test::sample_asset(test::base_shapes()[0], 9);
  asset.placement = {0.25, {1, -2, 3.5}};
  write_split(folder / "a.gltf", asset);
  expect_equal(read_progressive(folder / "a.gltf"), asset);
}

TEST(Placement, MustBeFinite) {
  ProgressiveAsset asset = test::sample_asset(test::base_shapes()[0], 9);
  asset.placement.scale = 0;
  EXPECT_ANY_THROW(glb_bytes(asset));
  asset.placement.scale = std::numeric_limits<double>::infinity();
  EXPECT_ANY_THROW(glb_bytes(asset));
}

}  // namespace
}  // namespace zerotree::gltf
