// Import and clean over real and hostile files: a clean manifold or a told refusal, and the counts
// that are known. Skipped where the folder of test meshes is missing.
#include <gtest/gtest.h>

#include <filesystem>
#include <optional>

#include "clean/clean_mesh.h"
#include "clean/manifold_check.h"
#include "import/import_mesh.h"
#include "mesh/error.h"

namespace zerotree::test {
namespace {

/// What is known of a file; -1 where nothing is.
struct KnownScan {
  const char* file;
  std::optional<ExitCode> refused = {};
  int components = -1, boundary_loops = -1, genus = -1;
};

std::ostream& operator<<(std::ostream& stream, const KnownScan& scan) {
  return stream << scan.file;
}

constexpr ExitCode unreadable = ExitCode::unreadable_input, topology = ExitCode::refused_topology;

const KnownScan known_scans[] = {
    {"boundary/holes.off", {}, 1, 7, 0},
    {"boundary/lato000.ply", {}, 10, 19, 0},
    {"boundary/mountain.obj", {}, 1, 1, 0},
    {"boundary/tower_holes.obj", {}, 1, 38, 0},
    {"colored/Laurana50k.ply", {}, 1, 4, 0},
    {"colored/rgb_nefertiti_unix.off", {}, 1, 0, 0},
    {"hostile/88566.stl", {}, 8, 0, 32},
    {"hostile/OutOfMemory.off", unreadable, -1, -1, -1},
    {"hostile/bathtub.obj", {}, -1, -1, -1},
    {"hostile/blobby-shuffled.off", {}, 1, 0, 0},
    {"hostile/chair_model.obj", {}, 3, -1, -1},
    {"hostile/cheese.off", {}, 1, 0, 133},
    {"hostile/conrod.stl", {}, 4, 3, 0},
    {"hostile/crash-30d6d0f7c529b3b66b4131700b7a4580cd7082df.ply", unreadable, -1, -1, -1},
    {"hostile/degtri_sliding.off", {}, 1, 1, 0},
    {"hostile/dragon_vrip_res2.ply.gz", {}, -1, -1, -1},
    {"hostile/empty.obj", unreadable, -1, -1, -1},
    {"hostile/empty.off", unreadable, -1, -1, -1},
    {"hostile/empty.ply", unreadable, -1, -1, -1},
    {"hostile/hourglass_ico.obj", {}, 2, 0, 0},
    {"hostile/invalid.off", unreadable, -1, -1, -1},
    {"hostile/malformed.obj", unreadable, -1, -1, -1},
    {"hostile/moebius.obj", topology, -1, -1, -1},
    {"hostile/payload_JVN42386607", unreadable, -1, -1, -1},
    {"hostile/pig.stl", {}, 17, 21, 0},
    {"hostile/quads_to_stitch.off", {}, 1, 1, 0},
    {"hostile/self_intersectA.obj", {}, 1, 0, 0},
    {"hostile/triangle_with_empty_solid.stl", {}, 1, 1, 0},
    // Welding closes it: its 151 components and 407 loops are seams of equal positions.
    {"large/dragon_vrip.ply.gz", {}, 1, 0, 55},
    {"large/igea.ply", {}, 1, 0, 0},
    {"large/lion_vase_poly.off", {}, 1, 0, 0},
    {"paper5/bunny.off", {}, 1, 1, 0},
    {"paper5/feline.off", {}, 1, 0, 2},
    {"paper5/horse.ply", {}, 1, 0, 0},
    {"textured/Duck.glb", {}, 1, 0, 0},
    {"textured/CesiumMan.glb", {}, 1, 0, 0},
    {"textured/DamagedHelmet.glb", {}, -1, -1, -1},
    {"textured/ycb_mug/textured.obj", {}, 1, 0, 3},
    {"textured/ycb_mustard_bottle/textured.obj", {}, 1, 0, 0},
};

std::filesystem::path shared_data() {
  return SHARED_DATA_FOLDER;
}

void expect_known(int known, std::uint64_t measured) {
  if (known < 0) return;
  EXPECT_EQ(measured, static_cast<std::uint64_t>(known));
}

class SharedScan : public testing::TestWithParam<KnownScan> {};

TEST_P(SharedScan, BecomesACleanManifoldOrIsRefused) {
  const KnownScan& known = GetParam();
  const std::filesystem::path path = shared_data() / known.file;
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "no test meshes in " << shared_data();
  try {
    const importer::ImportedMesh imported = importer::import_mesh(path, {}, {});
    const clean::CleanMesh c = clean::clean_mesh(imported.mesh, {}, {});
    ASSERT_FALSE(known.refused) << "was cleaned";
    EXPECT_EQ(clean::check_manifold(c.mesh), "");
    expect_known(known.components, c.component_count);
    expect_known(known.boundary_loops, c.report.boundary_loops);
    expect_known(known.genus, static_cast<std::uint64_t>(c.report.genus));
  } catch (const Error& error) {
    ASSERT_TRUE(known.refused) << error.what();
    EXPECT_EQ(error.code(), *known.refused) << error.what();
    EXPECT_GT(std::string(error.what()).size(), 20u);
  }
}

INSTANTIATE_TEST_SUITE_P(Files, SharedScan, testing::ValuesIn(known_scans));

TEST(SharedScans, DragonBeforeWeldingIsTheManifoldThatIsKnown) {
  const std::filesystem::path path = shared_data() / "large/dragon_vrip.ply.gz";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "no test meshes in " << shared_data();
  const importer::ImportedMesh imported = importer::import_mesh(path, {}, {});
  EXPECT_EQ(imported.vertex_count, 437645u);
  EXPECT_EQ(imported.face_count, 871414u);
  ASSERT_EQ(clean::check_manifold(imported.mesh), "");
  const clean::SurfaceTopology topology_of_file = clean::measure_topology(imported.mesh);
  EXPECT_EQ(topology_of_file.component_count, 151u);
  EXPECT_EQ(topology_of_file.boundary_loops, 407u);
  EXPECT_EQ(topology_of_file.genus, 46);
}

}  // namespace
}  // namespace zerotree::test
