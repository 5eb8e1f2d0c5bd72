// Every byte of small files changed to eight other values. A change is reported, or it changes
// nothing but decoded details, or nothing that is decoded: names, materials, stated errors,
// padding.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iostream>
#include <map>
#include <string>
#include <vector>

#include "encoded_assets.h"
#include "gltf/progressive_reader.h"
#include "gltf/progressive_writer.h"
#include "sample_assets.h"
#include "validate/file_validation.h"

namespace zerotree::validate {
namespace {

#if defined(__SANITIZE_ADDRESS__)
constexpr int kChangesEach = 1;  // ten times slower: one of the eight, another one for each byte
#else
constexpr int kChangesEach = 8;
#endif

struct SmallFile {
  std::string name;
  std::vector<std::uint8_t> bytes;
};

// As `convert` writes them by default: without normals, whose last digits nothing vouches for.
std::vector<std::uint8_t> bytes_of(gltf::ProgressiveAsset asset,
                                   const gltf::WriteOptions& options = {}) {
  asset.normals.clear();
  return gltf::glb_bytes(asset, options);
}

SmallFile small_file(const std::string& name) {
  if (name == "Closed")
    return {name, bytes_of(test::encoded_asset({"t", test::tetrahedron(), {}, {}}))};
  const std::vector<test::Shape> shapes = test::base_shapes();
  const auto creased = std::find_if(shapes.begin(), shapes.end(), [](const test::Shape& shape) {
    return !shape.crease_edges.empty();
  });
  if (name == "Creased") return {name, bytes_of(test::encoded_asset(*creased))};
  const test::Shape sphere{"sphere", test::in_canonical_order(test::sphere(1)), {}, {}};
  return {name, bytes_of(test::encoded_grid_asset(sphere), {.compress_base = true})};
}

bool is_reported(const ValidationReport& report) {
  return count_issues(report, gltf::Severity::error) +
             count_issues(report, gltf::Severity::warning) >
         0;
}

// Not atomically: waiting for the disk would take most of the time.
void write(const std::filesystem::path& path, const std::vector<std::uint8_t>& bytes) {
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()),
             static_cast<std::streamsize>(bytes.size()));
}

enum class Effect { reported, details, nothing, other };

// What an unreported change did, in view of what both files hold.
Effect effect_of(const gltf::ProgressiveAsset& before, const gltf::ProgressiveAsset& after) {
  const bool same_base = before.base.vertex_count == after.base.vertex_count &&
                         before.base.triangles == after.base.triangles &&
                         before.control_points == after.control_points;
  if (!same_base || before.levels != after.levels ||
      before.payload.size() != after.payload.size() || before.normals != after.normals)
    return Effect::other;
  return before.payload != after.payload ? Effect::details : Effect::nothing;
}

class SingleByteChanges : public testing::TestWithParam<const char*> {};

TEST_P(SingleByteChanges, AreReportedOrChangeDetailsOnly) {
  const test::TemporaryFolder folder;
  const std::filesystem::path path = folder / "changed.glb";
  const SmallFile file = small_file(GetParam());
  write(path, file.bytes);
  ASSERT_FALSE(is_reported(validate_file(path)));
  const gltf::ProgressiveAsset before = gltf::read_progressive(path);

  std::map<Effect, std::size_t> counts;
  std::vector<std::uint8_t> bytes = file.bytes;
  for (std::size_t i = 0; i < bytes.size(); ++i)
    for (int k = 0; k < kChangesEach; ++k) {
      const std::size_t bit = (i + static_cast<std::size_t>(k)) % 8;
      bytes[i] = static_cast<std::uint8_t>(file.bytes[i] ^ (1u << bit));
      write(path, bytes);
      const ValidationReport report = validate_file(path);
      Effect effect = Effect::reported;
      if (!is_reported(report)) {
        ASSERT_EQ(report.meshes.size(), 1u) << "byte " << i << ", bit " << bit;
        effect = effect_of(before, gltf::read_progressive(path));
        EXPECT_NE(effect, Effect::other) << "byte " << i << ", bit " << bit;
      }
      ++counts[effect];
      bytes[i] = file.bytes[i];
    }
  std::cout << file.name << ": of " << bytes.size() * kChangesEach << " changes "
            << counts[Effect::reported] << " reported, " << counts[Effect::details]
            << " of details within bounds, " << counts[Effect::nothing]
            << " of nothing that is decoded (names, materials, the table's numbers, padding)\n";
  EXPECT_GT(counts[Effect::reported], counts[Effect::details]);
  EXPECT_GT(counts[Effect::details], 0u);
}

INSTANTIATE_TEST_SUITE_P(Files, SingleByteChanges,
                         testing::Values("Closed", "Creased", "Compressed"),
                         [](const auto& file) { return std::string(file.param); });

}  // namespace
}  // namespace zerotree::validate
