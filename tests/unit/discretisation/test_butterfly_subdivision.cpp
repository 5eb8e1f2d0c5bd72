#include "discretisation/butterfly_subdivision.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "shapes.h"

namespace zerotree::discretisation {
namespace {

using domain::kNext;
using domain::VertexKind;

double height(const Eigen::Vector3d& p) {
  return 0.3 + 0.2 * p.x() - 0.1 * p.y();
}

// Every rule reproduces a plane, at boundaries, corners and any valence.
TEST(ButterflySubdivision, KeepsPlanes) {
  for (int valence : {3, 4, 5, 6, 7, 9}) {
    SCOPED_TRACE(valence);
    // A bipyramid's upper half pressed into a plane, and its ring: a boundary.
    TriangleMesh fan = test::midpoint_subdivide(test::bipyramid(valence), 1);
    for (Eigen::Vector3d& p : fan.positions) p.z() = height(p);
    const FeaturedMesh fine = butterfly_subdivide(find_features(fan, 180));
    for (const Eigen::Vector3d& p : fine.mesh.positions) EXPECT_NEAR(p.z(), height(p), 1e-12);
  }
  TriangleMesh sheet = test::grid(4, 3);
  for (Eigen::Vector3d& p : sheet.positions) p.z() = height(p);
  const FeaturedMesh fine = butterfly_subdivide(find_features(sheet, 180));
  for (const Eigen::Vector3d& p : fine.mesh.positions) {
    EXPECT_NEAR(p.z(), height(p), 1e-12);
    EXPECT_GE(p.x(), -1e-12);
    EXPECT_LE(p.x(), 4 + 1e-12);
  }
}

// Butterfly is exact for cubics on the regular lattice.
TEST(ButterflySubdivision, KeepsAParaboloidInsideARegularSheet) {
  TriangleMesh sheet = test::grid(8, 8);
  for (Eigen::Vector3d& p : sheet.positions) p.z() = p.squaredNorm();
  const FeaturedMesh fine = butterfly_subdivide(find_features(sheet, 180));
  for (const Eigen::Vector3d& p : fine.mesh.positions) {
    if (p.x() < 1.6 || p.x() > 6.4 || p.y() < 1.6 || p.y() > 6.4) continue;
    EXPECT_NEAR(p.z(), p.x() * p.x() + p.y() * p.y(), 1e-12);
  }
}

TEST(ButterflySubdivision, GoesTowardsTheSphere) {
  FeaturedMesh sphere = find_features(test::sphere(1), 180);
  for (int times = 0; times < 2; ++times) sphere = butterfly_subdivide(sphere);
  double least = 1, most = 1;
  for (const Eigen::Vector3d& p : sphere.mesh.positions) {
    least = std::min(least, p.norm());
    most = std::max(most, p.norm());
  }
  EXPECT_GT(least, 0.985);
  EXPECT_LT(most, 1.015);
}

TEST(ButterflySubdivision, KeepsACubeACube) {
  const TriangleMesh cube = test::midpoint_subdivide(test::voxel_surface({{0, 0, 0}}), 2);
  FeaturedMesh fine = find_features(cube, 0);
  for (int times = 0; times < 2; ++times) fine = butterfly_subdivide(fine);
  EXPECT_EQ(std::ranges::count(fine.kinds, VertexKind::corner), 8);
  for (const Eigen::Vector3d& p : fine.mesh.positions) {
    EXPECT_GE(p.minCoeff(), -1e-12);
    EXPECT_LE(p.maxCoeff(), 1 + 1e-12);
    EXPECT_LT(
        std::min(p.cwiseAbs().minCoeff(), (p - Eigen::Vector3d::Ones()).cwiseAbs().minCoeff()),
        1e-12);
  }
  std::size_t creases = 0;
  for (std::uint8_t bits : fine.topology.creases)
    creases += (bits & 1) + (bits >> 1 & 1) + (bits >> 2);
  EXPECT_EQ(creases, 2u * 12 * 16);
}

}  // namespace
}  // namespace zerotree::discretisation
