#include "validate/source_check.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <memory>

#include "changed_files.h"
#include "decode/prefix_surface.h"
#include "encoded_assets.h"
#include "export/atomic_file.h"
#include "gltf/progressive_writer.h"
#include "measure/surface_distance.h"
#include "mesh/error.h"
#include "sample_assets.h"

namespace zerotree::validate {
namespace {

using nlohmann::json;
using test::codes;
using test::extension;
using test::validate_bytes;
using Codes = std::vector<std::string>;

const std::string kPrefixes = "/meshes/0/extensions/ZEROTREE_mesh_progressive/prefixes/";

// A file, and a mesh it could have been made of: its surface with noise. The table is measured.
class MeasuredFile {
 public:
  MeasuredFile() : asset_(test::encoded_asset({"sphere", test::sphere(1), {}, {}})) {
    const test::TemporaryFolder folder;
    exporter::write_file_atomically(folder / "a.glb", gltf::glb_bytes(asset_));
    const decode::StreamFile file = decode::open_stream_file(folder / "a.glb");
    decode::PrefixSurface whole(file);
    whole.advance_to(file.bytes.size());
    scan_ = test::add_noise(decode::to_triangle_mesh(whole.surface()), 0.05, 1);
    asset_.source_diagonal = bounding_box_diagonal(scan_.positions);
    source_ = std::make_unique<SourceScan>(
        SourceScan{measure::SurfaceIndex(scan_), asset_.source_diagonal});
    decode::PrefixSurface prefix(file);
    for (gltf::PrefixEntry& entry : asset_.prefixes) {
      prefix.advance_to(entry.byte_length);
      entry.geometric_error =
          measure::compare_surfaces(source_->surface, decode::to_triangle_mesh(prefix.surface()),
                                    {.samples = 50'000})
              .symmetric.rms;
    }
    asset_.prefixes = gltf::monotone_prefixes(asset_.prefixes);
  }

  const gltf::ProgressiveAsset& asset() const { return asset_; }
  ValidationReport validate(const std::function<void(json&)>& change) const {
    ValidateOptions options;
    options.source = source_.get();
    return validate_bytes(test::with_json(asset_, change), "a.glb", options);
  }

 private:
  gltf::ProgressiveAsset asset_;
  TriangleMesh scan_;
  std::unique_ptr<const SourceScan> source_;
};

const MeasuredFile& file() {
  static const MeasuredFile file;
  return file;
}

void scale_errors(json& root, double factor) {
  for (json& entry : extension(root)["prefixes"])
    entry["geometricError"] = entry["geometricError"].get<double>() * factor;
}

TEST(Source, ConfirmsATrueTable) {
  const ValidationReport report = file().validate([](json&) {});
  ASSERT_EQ(codes(report), Codes{});
  const std::vector<MeasuredEntry>& measured = report.meshes[0].measured;
  ASSERT_EQ(measured.size(), file().asset().prefixes.size());
  for (std::size_t i = 0; i < measured.size(); ++i) {
    EXPECT_EQ(measured[i].bytes, file().asset().prefixes[i].byte_length);
    EXPECT_GT(measured[i].measured_error, 0);
    EXPECT_LE(measured[i].measured_error, 1.001 * measured[i].stated_error);
  }
}

TEST(Source, FindsErrorsThatAreUnderstated) {
  const ValidationReport report = file().validate([](json& root) { scale_errors(root, 0.5); });
  const Codes found = codes(report);
  EXPECT_EQ(std::count(found.begin(), found.end(), "PREFIX_ERROR_UNDERSTATED"), found.size());
  ASSERT_GE(found.size(), 4u);
  EXPECT_EQ(report.issues.front().pointer, kPrefixes + "0/geometricError");
  EXPECT_EQ(report.issues.back().pointer, kPrefixes + "4/geometricError");
}

// Too close to call by the samples of a table, so it is measured with more.
TEST(Source, FindsOneThatIsALittleUnderstated) {
  const auto report = [](double factor) {
    return file().validate([&](json& root) {
      extension(root)["prefixes"][4]["geometricError"] =
          factor * file().asset().prefixes[4].geometric_error;
    });
  };
  EXPECT_EQ(codes(report(0.95)), Codes{"PREFIX_ERROR_UNDERSTATED"});
  EXPECT_EQ(codes(report(0.98)), Codes{}) << "within the noise of sampling";
}

TEST(Source, FindsErrorsThatAreOverstated) {
  const ValidationReport report = file().validate([](json& root) {
    extension(root)["prefixes"][0]["geometricError"] =
        1.5 * file().asset().prefixes[0].geometric_error;
  });
  ASSERT_EQ(codes(report), Codes{"PREFIX_ERROR_OVERSTATED"});
  EXPECT_EQ(report.issues[0].pointer, kPrefixes + "0/geometricError");
}

TEST(Source, FindsADiagonalThatIsNotItsOwn) {
  const ValidationReport report = file().validate([](json& root) {
    extension(root)["sourceDiagonal"] = 1.002 * file().asset().source_diagonal;
  });
  ASSERT_EQ(codes(report), Codes{"SOURCE_DIAGONAL_MISMATCH"});
  EXPECT_TRUE(report.issues[0].pointer.ends_with("/sourceDiagonal"));
}

TEST(Source, IsNotMeasuredAgainstAFileWithErrors) {
  const ValidationReport report =
      file().validate([](json& root) { extension(root)["bounds"]["max"][0] = 0.1; });
  const Codes found = codes(report);
  EXPECT_EQ(found.back(), "SOURCE_NOT_MEASURED");
  EXPECT_TRUE(report.meshes[0].measured.empty());
}

TEST(Source, IsForOneMeshWithATable) {
  EXPECT_THROW(file().validate([](json& root) { root["meshes"].push_back(root["meshes"][0]); }),
               Error);
  EXPECT_THROW(file().validate([](json& root) {
    root["meshes"][0].erase("extensions");
    root.erase("extensionsUsed");
  }),
               Error);
  const TriangleMesh scan = test::sphere(2);
  const SourceScan source{measure::SurfaceIndex(scan), 3};
  ValidateOptions options;
  options.source = &source;
  EXPECT_THROW(validate_bytes(test::encoded_stream(test::base_shapes()[0]), "a.zt", options),
               Error);
}

}  // namespace
}  // namespace zerotree::validate
