#include "repair/hole_filling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "clean/manifold_check.h"
#include "mesh/error.h"
#include "shapes.h"

namespace zerotree::repair {
namespace {

using Eigen::Vector3d;

// `mesh` without the faces whose centroid `is_gone`; unused vertices dropped.
TriangleMesh without(const TriangleMesh& mesh,
                     const std::function<bool(const Vector3d&)>& is_gone) {
  TriangleMesh cut;
  std::map<std::uint32_t, std::uint32_t> index;
  for (const Triangle& t : mesh.triangles) {
    if (is_gone((mesh.positions[t[0]] + mesh.positions[t[1]] + mesh.positions[t[2]]) / 3)) continue;
    Triangle& kept = cut.triangles.emplace_back();
    for (int k = 0; k < 3; ++k) {
      const auto [place, is_new] =
          index.try_emplace(t[k], static_cast<std::uint32_t>(cut.positions.size()));
      if (is_new) cut.positions.push_back(mesh.positions[t[k]]);
      kept[k] = place->second;
    }
  }
  return cut;
}

std::uint64_t loops_of(const TriangleMesh& mesh) {
  return clean::measure_topology(mesh).boundary_loops;
}

// A sphere with two holes: a small one at the top, a larger one at the side.
TriangleMesh holed_sphere(int times) {
  return without(test::sphere(times), [](const Vector3d& p) {
    return p.normalized().z() > 0.97 || p.normalized().x() > 0.8;
  });
}

TEST(HoleFilling, FillsWhatIsSmallEnough) {
  const TriangleMesh mesh = holed_sphere(4);
  ASSERT_EQ(loops_of(mesh), 2u);
  const FilledMesh none = fill_holes(mesh, {.size = 0.1}, {});
  EXPECT_EQ(none.mesh.triangles, mesh.triangles);
  EXPECT_EQ(none.report.left_rims.size(), 2u);
  const FilledMesh one = fill_holes(mesh, {.size = 1.0}, {});
  EXPECT_EQ(loops_of(one.mesh), 1u);
  ASSERT_EQ(one.report.filled_rims.size(), 1u);
  const double circle = 2 * 3.1416 * std::sqrt(1 - 0.97 * 0.97);
  EXPECT_GT(one.report.filled_rims[0], circle);  // the rim is jagged
  EXPECT_LT(one.report.filled_rims[0], 2 * circle);
  const FilledMesh both = fill_holes(mesh, {.size = 2.0}, {});
  EXPECT_EQ(loops_of(both.mesh), 0u);
  EXPECT_EQ(clean::check_manifold(both.mesh), "");
  EXPECT_EQ(both.mesh.triangles.size(), mesh.triangles.size() + both.report.added_faces);
}

TEST(HoleFilling, GoesOnAsTheSurfaceAroundAndAsDense) {
  for (int times : {3, 4, 5}) {
    SCOPED_TRACE(times);
    const TriangleMesh mesh = holed_sphere(times), whole = test::sphere(times);
    const FilledMesh filled = fill_holes(mesh, {.size = 2.0}, {});
    EXPECT_EQ(clean::check_manifold(filled.mesh), "");
    EXPECT_EQ(loops_of(filled.mesh), 0u);
    EXPECT_NEAR(static_cast<double>(filled.mesh.positions.size()),
                static_cast<double>(whole.positions.size()),
                0.06 * static_cast<double>(whole.positions.size()));
    for (std::size_t v = mesh.positions.size(); v < filled.mesh.positions.size(); ++v)
      EXPECT_NEAR(filled.mesh.positions[v].norm(), 1.0, 0.08);
  }
}

// Random caves in a noisy sphere: rims of all shapes, and more than 200 edges.
TEST(HoleFilling, LeavesAManifoldOnRandomHoles) {
  for (std::uint32_t seed : {1u, 2u, 3u, 4u}) {
    SCOPED_TRACE(seed);
    const TriangleMesh sphere = test::add_noise(test::sphere(5), 0.2, seed);
    const double s = seed;
    const TriangleMesh mesh = without(sphere, [s](const Vector3d& p) {
      return std::sin(5 * p.x() + s) * std::sin(4 * p.y() + 2 * s) * std::sin(6 * p.z() - s) > 0.35;
    });
    ASSERT_EQ(clean::check_manifold(mesh), "");  // no holes that touch in a vertex
    ASSERT_GT(loops_of(mesh), 3u);
    const FilledMesh filled = fill_holes(mesh, {.size = 10}, {});
    EXPECT_EQ(clean::check_manifold(filled.mesh), "");
    EXPECT_EQ(loops_of(filled.mesh), filled.report.left_rims.size());
    EXPECT_GT(filled.report.filled_rims.size(), 3u);
  }
}

TEST(HoleFilling, FillsLongRimsToo) {
  const TriangleMesh mesh =
      without(test::sphere(6), [](const Vector3d& p) { return p.normalized().z() > 0.3; });
  const FilledMesh filled = fill_holes(mesh, {.size = 10}, {});
  EXPECT_EQ(loops_of(filled.mesh), 0u);
  EXPECT_EQ(clean::check_manifold(filled.mesh), "");
}

TEST(HoleFilling, LeavesTheBordersOfSheets) {
  const TriangleMesh triangle{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
  for (const TriangleMesh& sheet : {triangle, test::grid(1, 1), test::grid(6, 4)}) {
    const FilledMesh filled = fill_holes(sheet, {.size = 1e9}, {});
    EXPECT_EQ(filled.mesh.triangles, sheet.triangles);
    EXPECT_EQ(filled.report.left_rims.size(), 1u);
  }
}

TEST(HoleFilling, FillsAHoleInASheetFlat) {
  const TriangleMesh sheet = without(test::grid(12, 12), [](const Vector3d& p) {
    return std::abs(p.x() - 6) < 2 && std::abs(p.y() - 6) < 2;
  });
  const FilledMesh filled = fill_holes(sheet, {.size = 7}, {});
  EXPECT_EQ(filled.report.filled_rims.size(), 1u);
  EXPECT_NEAR(filled.report.filled_rims[0], 16.0, 1e-9);
  EXPECT_EQ(clean::check_manifold(filled.mesh), "");
  for (const Vector3d& p : filled.mesh.positions) EXPECT_NEAR(p.z(), 0, 1e-9);
}

// An open tetrahedron: every edge among the rim's points exists already.
TEST(HoleFilling, ClosesATetrahedron) {
  TriangleMesh open = test::tetrahedron();
  open.triangles.pop_back();
  const FilledMesh filled = fill_holes(open, {.size = 10}, {});
  EXPECT_EQ(clean::check_manifold(filled.mesh), "");
  EXPECT_EQ(loops_of(filled.mesh), 0u);
}

}  // namespace
}  // namespace zerotree::repair
