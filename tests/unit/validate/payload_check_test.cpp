// What decoding shows of files whose structure is right.
#include "validate/payload_check.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "bitstream/stream_header.h"
#include "changed_files.h"
#include "encode/header_writer.h"
#include "encoded_assets.h"
#include "gltf/progressive_writer.h"
#include "sample_assets.h"
#include "validate/prefix_plan.h"

namespace zerotree::validate {
namespace {

using nlohmann::json;
using test::codes;
using test::encoded_asset;
using test::extension;
using test::issue_with;
using test::validate_bytes;
using test::with_json;
using Codes = std::vector<std::string>;

const std::string kExtension = "/meshes/0/extensions/ZEROTREE_mesh_progressive";

gltf::ProgressiveAsset sphere_asset(double detail_scale = 1) {
  return encoded_asset({"sphere", test::sphere(1), {}, {}}, detail_scale);
}

ValidationReport validate_asset(const gltf::ProgressiveAsset& asset,
                                const ValidateOptions& options = {}) {
  return validate_bytes(gltf::glb_bytes(asset), "a.glb", options);
}

TEST(Prefixes, OfARightFileAreDecodedAtTheTableAndElsewhere) {
  const auto asset = sphere_asset();
  const ValidationReport report = validate_asset(asset);
  ASSERT_EQ(codes(report), Codes{});
  ASSERT_EQ(report.meshes.size(), 1u);
  EXPECT_EQ(report.meshes[0].finest_triangles, 16 * asset.base.triangles.size());
  EXPECT_GT(report.meshes[0].prefixes_decoded, asset.prefixes.size());
  EXPECT_LE(report.meshes[0].prefixes_decoded, asset.prefixes.size() + 8);
  const ValidationReport few = validate_asset(asset, {.random_prefixes = 0});
  EXPECT_EQ(few.meshes[0].prefixes_decoded, asset.prefixes.size());  // no byte is an entry
}

TEST(Prefixes, AreFewerWhereManyMeshesShareTheTime) {
  const auto asset = sphere_asset();
  const auto decoded = [&](std::size_t meshes) {
    gltf::Issues issues;
    const auto facts = check_payload(asset, {"/meshes/0", {}, meshes}, {}, {}, issues);
    EXPECT_EQ(issues.empty(), facts.prefixes_decoded >= asset.prefixes.size());
    return facts.prefixes_decoded;
  };
  const std::uint64_t cost = surface_cost(42, 642);
  EXPECT_GT(decoded(1), asset.prefixes.size());
  EXPECT_EQ(decoded(kMostCost / cost / 3), asset.prefixes.size());
  EXPECT_EQ(decoded(kMostTableCost / cost / 3), 3u);
  EXPECT_EQ(decoded(kMostTableCost), 1u);
}

TEST(Bounds, ThatAPrefixBetweenEntriesLeavesAreAWarning) {
  auto asset = sphere_asset();
  // Of the entries only the last one is left, whose surface is larger than that of the base alone.
  asset.prefixes = {asset.prefixes.back()};
  auto bytes = with_json(asset, [](json& root) { extension(root)["bounds"]["min"][0] = -0.5; });
  EXPECT_EQ(codes(validate_bytes(bytes)), (Codes{"SURFACE_OUT_OF_BOUNDS", "PREFIX_OUT_OF_BOUNDS"}));

  // Large details: only the whole surface needs these bounds, and without bytes it is smaller.
  auto large = sphere_asset(30);
  large.prefixes = {{0, 0.5}, {large.payload_length, 0.1}};
  const auto report =
      validate_bytes(with_json(large, [](json& root) { extension(root)["prefixes"].erase(1); }));
  EXPECT_NE(issue_with(report, "PREFIX_END").detail, "");
  EXPECT_EQ(issue_with(report, "SURFACE_OUT_OF_BOUNDS").detail, "");
  const gltf::Issue leaves = issue_with(report, "PREFIX_OUT_OF_BOUNDS");
  EXPECT_EQ(leaves.pointer, kExtension + "/bounds");
  EXPECT_NE(leaves.detail.find("after " + std::to_string(large.payload_length) + " bytes"),
            std::string::npos)
      << leaves.detail;
}

TEST(Bounds, FarBeyondTheSurfacesAreAWarning) {
  const auto report =
      validate_bytes(with_json([](json& root) { extension(root)["bounds"]["max"][2] = 3; }));
  ASSERT_EQ(codes(report), Codes{"BOUNDS_LOOSE"});
  EXPECT_EQ(report.issues[0].pointer, kExtension + "/bounds");
}

TEST(SourceDiagonal, FarFromTheBasesSizeIsAWarning) {
  for (const double factor : {0.2, 5.0}) {
    auto asset = sphere_asset();
    asset.source_diagonal *= factor;
    const Codes found = codes(validate_asset(asset));
    EXPECT_EQ(std::count(found.begin(), found.end(), "SOURCE_DIAGONAL_IMPLAUSIBLE"), 1) << factor;
  }
  auto asset = sphere_asset();
  asset.source_diagonal *= 1.5;
  EXPECT_EQ(codes(validate_asset(asset)), Codes{});
}

TEST(TrailingBytes, AreAWarning) {
  auto asset = sphere_asset();
  const std::uint64_t end = asset.payload_length;
  asset.payload.insert(asset.payload.end(), 5, 0);
  asset.payload_length += 5;
  asset.prefixes.push_back({asset.payload_length, 0.0625});
  ValidationReport report = validate_asset(asset);
  ASSERT_EQ(codes(report), Codes{"PAYLOAD_TRAILING_BYTES"});
  EXPECT_EQ(report.issues[0].detail,
            "it ends after " + std::to_string(end) + " of " + std::to_string(asset.payload_length));

  asset.prefixes.insert(asset.prefixes.end() - 1, {end + 2, 0.0625});
  report = validate_asset(asset);
  ASSERT_EQ(codes(report), (Codes{"PAYLOAD_TRAILING_BYTES", "PREFIX_BEYOND_STREAM"}));
  EXPECT_EQ(report.issues[1].pointer, kExtension + "/prefixes/5/byteLength");

  auto stream = test::encoded_stream(test::base_shapes()[0]);
  stream.push_back(7);
  EXPECT_EQ(codes(validate_bytes(stream, "a.zt")), Codes{"PAYLOAD_TRAILING_BYTES"});
}

// Two sheets that meet in a line with vertices of their own, and whose details differ there.
gltf::ProgressiveAsset cracked_asset() {
  const TriangleMesh mesh = test::disjoint_union(test::grid(2, 2), test::grid(2, 2), {2, 0, 0});
  return encoded_asset({"sheets", mesh, {}, {}});
}

TEST(Seams, WithinAPrimitiveThatComeApartAreAWarning) {
  const ValidationReport report = validate_asset(cracked_asset());
  ASSERT_EQ(codes(report), (Codes{"BASE_SEAM", "SURFACE_SEAM_OPEN"}));
  EXPECT_EQ(report.issues[1].pointer, "/meshes/0");
  EXPECT_NE(report.issues[1].detail.find("base edges "), std::string::npos);
}

TEST(Seams, BetweenPrimitivesThatComeApartAreAnError) {
  const auto in_two = [](json& root) {
    json& primitives = root["meshes"][0]["primitives"];
    const std::size_t indices = primitives[0]["indices"];
    json second = root["accessors"][indices];
    root["accessors"][indices]["count"] = 24;
    second["count"] = 24;
    second["byteOffset"] = 24;
    root["accessors"].push_back(second);
    primitives.push_back(primitives[0]);
    primitives[1]["indices"] = root["accessors"].size() - 1;
  };
  const ValidationReport report = validate_bytes(with_json(cracked_asset(), in_two));
  ASSERT_EQ(codes(report), (Codes{"BASE_SEAM", "SURFACE_CRACKED"}));
  EXPECT_EQ(report.issues[1].pointer, "/meshes/0");
}

TEST(Seams, OfAnElementaryStreamAreFound) {
  const TriangleMesh mesh = test::disjoint_union(test::grid(2, 2), test::grid(2, 2), {2, 0, 0});
  const auto stream = test::encoded_stream({"sheets", mesh, {}, {}});
  EXPECT_EQ(codes(validate_bytes(stream, "a.zt")), (Codes{"BASE_SEAM", "SURFACE_SEAM_OPEN"}));
}

TEST(Size, IsRefusedExactlyBeyondTheLimit) {
  const auto asset = sphere_asset();
  const std::uint64_t vertices = validate_asset(asset).meshes[0].finest_vertices;
  EXPECT_EQ(codes(validate_asset(asset, {.max_vertices = vertices})), Codes{});
  const ValidationReport report = validate_asset(asset, {.max_vertices = vertices - 1});
  ASSERT_EQ(codes(report), Codes{"PAYLOAD_TOO_LARGE"});
  EXPECT_EQ(report.meshes[0].finest_vertices, 0u);
  EXPECT_EQ(report.meshes[0].finest_triangles, 16 * asset.base.triangles.size());
}

// Each of these would take from 100 MB to 10^19 bytes if it were believed.
TEST(Size, OfAnAbsurdHeaderIsRefusedAtOnce) {
  bitstream::StreamHeader header;
  header.levels = 14;
  header.planes = 30;
  header.finest_step = encode::storable_step(0.001);
  header.positions = {{}, encode::storable_scale(header.finest_step, 0.01), 12, 4};
  for (const std::uint32_t vertices : {4u, 1000u, 1u << 20, 1u << 28}) {
    header.vertex_count = vertices;
    header.face_count = 2 * vertices - 4;
    auto stream = encode::write_header(header);
    stream.resize(stream.size() + 100, 0x5a);
    EXPECT_EQ(codes(validate_bytes(stream, "a.zt")), Codes{"PAYLOAD_TOO_LARGE"}) << vertices;
  }
  header.levels = 0;
  header.planes = 0;
  header.vertex_count = 1u << 24;
  header.face_count = 2 * header.vertex_count - 4;
  EXPECT_EQ(codes(validate_bytes(encode::write_header(header), "a.zt")),
            Codes{"PAYLOAD_INCOMPLETE"});
}

}  // namespace
}  // namespace zerotree::validate
