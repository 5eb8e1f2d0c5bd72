#include "domain/base_size.h"

#include <gtest/gtest.h>

#include <cmath>

#include "domain/domain.h"
#include "domain/shape_complexity.h"
#include "shapes.h"

namespace zerotree::domain {
namespace {

TriangleTopology topology_of(const TriangleMesh& mesh) {
  return build_topology(static_cast<std::uint32_t>(mesh.positions.size()), mesh.triangles);
}

double complexity_of(const TriangleMesh& mesh) {
  return shape_complexity(mesh, topology_of(mesh));
}

// Twelve pieces of a few faces each, beside a sphere.
TriangleMesh sphere_with_pieces(const TriangleMesh& piece) {
  TriangleMesh mesh = test::sphere(5);
  for (int i = 0; i < 12; ++i) mesh = test::disjoint_union(mesh, piece, {1.5 + 1.5 * i, 0.0, 0.0});
  return mesh;
}

TEST(ShapeComplexity, OfASphereIsEightPiAtAnyScaleAndDensity) {
  for (int times : {4, 5, 6}) {
    TriangleMesh sphere = test::sphere(times);
    for (Eigen::Vector3d& p : sphere.positions) p *= 1000;
    EXPECT_GT(complexity_of(sphere), 22.0);
    EXPECT_LT(complexity_of(sphere), 38.0);
  }
}

TEST(ShapeComplexity, IsNothingForPlanesAndCreases) {
  EXPECT_LT(complexity_of(test::grid(20, 20)), 1e-9);
  const TriangleMesh cube = test::midpoint_subdivide(test::voxel_surface({{0, 0, 0}}), 4);
  Domain domain = build_domain(cube, {}, {});
  TriangleTopology topology = topology_of(cube);
  EXPECT_GT(shape_complexity(cube, topology), 100.0);
  for (std::uint32_t f = 0; f < topology.faces.size(); ++f)
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d middle =
          (cube.positions[topology.faces[f][k]] + cube.positions[topology.faces[f][kNext[k]]]) / 2;
      int on_faces = 0;
      for (int axis = 0; axis < 3; ++axis)
        on_faces += middle[axis] < 1e-9 || middle[axis] > 1 - 1e-9 ? 1 : 0;
      if (on_faces == 2)
        topology.creases[f] = static_cast<std::uint8_t>(topology.creases[f] | 1 << k);
    }
  EXPECT_LT(shape_complexity(cube, topology), 1e-9);
}

// Noise of a tenth of an edge turns faces by ten degrees and more; base sizes follow the cube root.
TEST(ShapeComplexity, HardlySeesNoise) {
  const TriangleMesh smooth = test::add_bumps(test::sphere(6), 0.02, 2.0);
  const double without = complexity_of(smooth);
  EXPECT_NEAR(complexity_of(test::add_noise(smooth, 0.1, 3)), without, 0.4 * without);
}

TEST(BaseSize, GivesTheFinestMeshTheInputsDensity) {
  for (int times : {3, 4, 5, 6}) {
    const TriangleMesh sphere = test::sphere(times);
    const auto components = count_components(topology_of(sphere), {});
    const double base_faces = 2.0 * automatic_base_size(components, complexity_of(sphere), {}) - 4;
    const int levels =
        automatic_levels(static_cast<std::size_t>(base_faces), sphere.triangles.size(), {});
    const double ratio =
        base_faces * std::pow(4, levels) / static_cast<double>(sphere.triangles.size());
    EXPECT_LE(ratio, 4.0) << times;
    EXPECT_GE(ratio, 1.5) << times;
    EXPECT_GE(base_faces, 60) << times;
  }
}

TEST(BaseSize, GrowsWithTheShape) {
  const auto components = count_components(topology_of(test::sphere(6)), {});
  EXPECT_LT(automatic_base_size(components, 30, {}), automatic_base_size(components, 30'000, {}));
}

// A base as large as the depth allows is worth its bytes only where small errors are asked for.
TEST(BaseSize, IsWhatTheShapeNeedsWhereALargeErrorWillDo) {
  const auto components = count_components(topology_of(test::sphere(6)), {});
  const auto size = [&](double max_error) {
    return automatic_base_size(components, 30'000, {max_error, 6e-5});
  };
  EXPECT_LT(size(3e-4), size(0));
  EXPECT_EQ(size(3e-4), size(1e-2));
  EXPECT_EQ(size(1e-4), size(0));
}

TEST(BaseSize, TinyComponentsAreTheirOwnBase) {
  const TriangleMesh triangle{{{0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}}, {{0, 1, 2}}};
  const TriangleMesh sheet{{{0, 0, 0}, {0.1, 0, 0}, {0.1, 0.1, 0}, {0, 0.1, 0}},
                           {{0, 1, 2}, {0, 2, 3}}};
  TriangleMesh tetrahedron = test::tetrahedron();
  for (Eigen::Vector3d& p : tetrahedron.positions) p *= 0.05;
  for (const TriangleMesh& piece : {triangle, sheet, tetrahedron}) {
    const TriangleMesh mesh = sphere_with_pieces(piece);
    const Domain domain = build_domain(mesh, {}, {});
    EXPECT_EQ(domain.report.components, 13u);
    std::vector<std::uint8_t> removed(mesh.positions.size(), 0);
    for (const CollapseRecord& record : domain.collapses) removed[record.removed] = 1;
    for (std::size_t v = test::sphere(5).positions.size(); v < mesh.positions.size(); ++v)
      EXPECT_EQ(removed[v], 0);
    EXPECT_LE(domain.report.base_vertices, domain.report.target_base_vertices);
    const int levels = automatic_levels(domain.base_faces.size(), mesh.triangles.size(), {});
    EXPECT_LE(std::pow(4, levels) * domain.report.base_faces,
              4.0 * static_cast<double>(mesh.triangles.size()));
  }
}

// A thousand triangles need a thousand base triangles, so few levels are left; the base of the rest
// is made larger for it.
TEST(BaseSize, ManyTinyComponentsDoNotMakeTheFinestMeshExplode) {
  TriangleMesh mesh = test::sphere(5);
  for (int i = 0; i < 1000; ++i) {
    const auto n = static_cast<std::uint32_t>(mesh.positions.size());
    const Eigen::Vector3d at(1.2 + 0.05 * (i % 10), 0.05 * (i / 10 % 10), 0.05 * (i / 100));
    for (const Eigen::Vector3d& corner :
         {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(0.02, 0, 0), Eigen::Vector3d(0, 0.02, 0)})
      mesh.positions.push_back(at + corner);
    mesh.triangles.push_back({n, n + 1, n + 2});
  }
  const Domain domain = build_domain(mesh, {}, {});
  EXPECT_GE(domain.report.base_vertices, 3000u + 100);
  const int levels = automatic_levels(domain.base_faces.size(), mesh.triangles.size(), {});
  EXPECT_GE(levels, 2);
  EXPECT_LE(std::pow(4, levels) * domain.report.base_faces,
            4.0 * static_cast<double>(mesh.triangles.size()));
}

TEST(BaseSize, LevelsFollowTheErrorAskedFor) {
  const int full = automatic_levels(360, 100'000, {});
  EXPECT_EQ(full, 5);
  EXPECT_EQ(automatic_levels(360, 100'000, {0, 6e-5}), full);
  EXPECT_EQ(automatic_levels(360, 100'000, {1e-4, 6e-5}), full);
  EXPECT_EQ(automatic_levels(360, 100'000, {5e-5, 6e-5}), full + 1);
  EXPECT_EQ(automatic_levels(360, 100'000, {3e-4, 6e-5}), full - 1);
  EXPECT_EQ(automatic_levels(360, 100'000, {1e-1, 6e-5}), 2);
}

// ... whose base is held up by limbs or features.
TEST(BaseSize, LevelsOfADenseScanMayMakeThreeTimesItsFaces) {
  EXPECT_EQ(automatic_levels(2600, 900'000, {}), 5);
  EXPECT_EQ(automatic_levels(2700, 900'000, {}), 4);
}

TEST(BaseSize, LevelsOfTinyMeshesReachTwoThousandFaces) {
  EXPECT_EQ(automatic_levels(4, 4, {}), 5);
  EXPECT_EQ(automatic_levels(20, 20, {}), 4);
}

}  // namespace
}  // namespace zerotree::domain
