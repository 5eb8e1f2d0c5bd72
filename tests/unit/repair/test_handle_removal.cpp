#include "repair/handle_removal.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "clean/clean_mesh.h"
#include "clean/manifold_check.h"
#include "import/import_mesh.h"
#include "shapes.h"

namespace zerotree::repair {
namespace {

// A plate of `length` x 3 x 1 cubes with a hole of one cube every other cube.
TriangleMesh plate(int holes, int times) {
  std::vector<std::array<int, 3>> cubes;
  for (int x = 0; x < 2 * holes + 1; ++x)
    for (int y = 0; y < 3; ++y)
      if (y != 1 || x % 2 == 0) cubes.push_back({x, y, 0});
  return test::midpoint_subdivide(test::voxel_surface(cubes), times);
}

void expect_genus(const TriangleMesh& mesh, std::int64_t genus) {
  EXPECT_EQ(clean::check_manifold(mesh), "");
  const clean::SurfaceTopology topology = clean::measure_topology(mesh);
  EXPECT_EQ(topology.genus, genus);
  EXPECT_EQ(topology.component_count, 1u);
  EXPECT_EQ(topology.boundary_loops, 0u);
}

// The shortest loops of the plate go through a hole, or around a bar of 1 x 1: 4 along the edges.
TEST(HandleRemoval, CutsHandlesShorterThanAsked) {
  for (int holes : {1, 2, 5})
    for (int times : {1, 2}) {
      SCOPED_TRACE(std::to_string(holes) + " " + std::to_string(times));
      const TriangleMesh mesh = plate(holes, times);
      const HandleFreeMesh kept = remove_handles(mesh, {.size = 2.5}, {});
      EXPECT_EQ(kept.mesh.triangles, mesh.triangles);
      EXPECT_EQ(kept.report.genus_after, static_cast<std::uint64_t>(holes));
      const HandleFreeMesh removed = remove_handles(mesh, {.size = 4.5}, {});
      expect_genus(removed.mesh, 0);
      EXPECT_EQ(removed.report.genus_before, static_cast<std::uint64_t>(holes));
      ASSERT_EQ(removed.report.loops.size(), static_cast<std::size_t>(holes));
      for (double length : removed.report.loops) EXPECT_LE(length, 4.0 + 1e-9);
    }
}

// A thin handle and a thick one: only the thin one goes.
TEST(HandleRemoval, KeepsLongerHandles) {
  std::vector<std::array<int, 3>> cubes;
  for (int x = 0; x < 12; ++x)
    for (int y = 0; y < 4; ++y)
      for (int z = 0; z < 4; ++z) cubes.push_back({x, y, z});
  for (int y = 4; y < 9; ++y) cubes.push_back({0, y, 0});  // a bar of 1 x 1,
  for (int x = 1; x < 5; ++x) cubes.push_back({x, 8, 0});
  for (int y = 4; y < 8; ++y) cubes.push_back({4, y, 0});
  for (int x = 6; x < 12; ++x)  // and one of 2 x 2
    for (int y = 4; y < 10; ++y)
      for (int z = 0; z < 2; ++z)
        if (x < 8 || x > 9 || y > 7) cubes.push_back({x, y, z});
  const TriangleMesh mesh = test::voxel_surface(cubes);
  expect_genus(mesh, 2);
  const HandleFreeMesh one = remove_handles(mesh, {.size = 6}, {});
  expect_genus(one.mesh, 1);
  ASSERT_EQ(one.report.loops.size(), 1u);
  EXPECT_LE(one.report.loops[0], 4 + 1e-9);
  expect_genus(remove_handles(mesh, {.size = 9}, {}).mesh, 0);
}

TEST(HandleRemoval, LeavesSurfacesWithoutHandles) {
  for (const TriangleMesh& mesh : {test::sphere(3), test::grid(4, 4)}) {
    const HandleFreeMesh same = remove_handles(mesh, {.size = 100}, {});
    EXPECT_EQ(same.mesh.triangles, mesh.triangles);
    EXPECT_TRUE(same.report.loops.empty());
  }
}

TEST(HandleRemoval, WorksBesideBoundaries) {
  TriangleMesh mesh = plate(2, 2);
  mesh.triangles.erase(mesh.triangles.begin());  // the corner of the plate
  const HandleFreeMesh removed = remove_handles(mesh, {.size = 4.5}, {});
  EXPECT_EQ(clean::check_manifold(removed.mesh), "");
  const clean::SurfaceTopology topology = clean::measure_topology(removed.mesh);
  EXPECT_EQ(topology.genus, 0);
  EXPECT_EQ(topology.boundary_loops, 1u);
}

TEST(HandleRemoval, TakesAllHandlesOfCheese) {
  const std::filesystem::path path =
      std::filesystem::path(SHARED_DATA_FOLDER) / "hostile/cheese.off";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "no test meshes in " << SHARED_DATA_FOLDER;
  const TriangleMesh mesh =
      clean::clean_mesh(importer::import_mesh(path, {}, {}).mesh, {}, {}).mesh;
  const double size = 0.3 * bounding_box_diagonal(mesh.positions);
  const HandleFreeMesh removed = remove_handles(mesh, {.size = size}, {});
  EXPECT_EQ(removed.report.genus_before, 133u);
  EXPECT_EQ(clean::check_manifold(removed.mesh), "");
  EXPECT_EQ(clean::measure_topology(removed.mesh).genus,
            static_cast<std::int64_t>(removed.report.genus_after));
  EXPECT_EQ(removed.report.genus_after + removed.report.loops.size(), 133u);
  EXPECT_LT(removed.report.genus_after, 60u);
}

}  // namespace
}  // namespace zerotree::repair
