#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstring>
#include <numbers>

#include "measure/surface_distance.h"
#include "measure/surface_samples.h"
#include "mesh/error.h"
#include "shapes.h"

namespace zerotree::measure {
namespace {

constexpr DistanceOptions quick{.samples = 50'000, .threads = 1};

TriangleMesh moved(TriangleMesh mesh, const Eigen::Affine3d& motion) {
  for (Eigen::Vector3d& p : mesh.positions) p = motion * p;
  return mesh;
}

// Two spheres of radius 1 and 1.02 whose triangles do not face each other: 0.02 everywhere, but
// for facets that lie at most 1.3e-4 below their sphere.
TEST(SurfaceDistance, OfConcentricSpheresIsTheDifferenceOfTheirRadii) {
  const TriangleMesh inner = test::sphere(5);
  const Eigen::AngleAxisd turn(0.7, Eigen::Vector3d(1, 2, 3).normalized());
  const TriangleMesh outer = moved(test::sphere(5), Eigen::Affine3d(turn) * Eigen::Scaling(1.02));
  const SurfaceDistance distance = compare_surfaces(inner, outer, quick);
  for (const DirectedDistance& way : {distance.from_reference, distance.from_test}) {
    EXPECT_NEAR(way.rms, 0.02, 0.01 * 0.02);
    EXPECT_NEAR(way.mean, 0.02, 0.01 * 0.02);
    EXPECT_NEAR(way.maximum, 0.02, 0.02 * 0.02);
    EXPECT_LT(way.normal_max_degrees, 3.0);
  }
  EXPECT_NEAR(distance.relative_rms(), 0.02 / (2.0 * std::sqrt(3.0)), 0.01 * 0.02);
}

// Squares [0,10]^2 at z = 0 and [s,10+s]x[0,10] at z = h: over the share s/10 of either, the
// nearest point lies on the other's border, at sqrt(h^2 + x^2) with x uniform in 0..s.
TEST(SurfaceDistance, OfOffsetPatchesIsTheIntegral) {
  const double h = 0.25, s = 3.0, width = 10.0;
  const TriangleMesh patch = test::grid(10, 10);
  const TriangleMesh other =
      moved(test::grid(10, 10), Eigen::Affine3d(Eigen::Translation3d(s, 0, h)));
  const double rms = std::sqrt(h * h + s * s * s / (3.0 * width));
  const double far = std::sqrt(h * h + s * s);
  const double border = 0.5 * (s * far + h * h * std::log((s + far) / h));
  const double mean = (border + h * (width - s)) / width;
  const SurfaceDistance distance = compare_surfaces(patch, other, quick);
  for (const DirectedDistance& way : {distance.from_reference, distance.from_test}) {
    EXPECT_NEAR(way.rms, rms, 0.01 * rms);
    EXPECT_NEAR(way.mean, mean, 0.01 * mean);
    EXPECT_DOUBLE_EQ(way.maximum, far);  // at a corner: samples alone would miss it
    EXPECT_EQ(way.normal_max_degrees, 0.0);
  }
  EXPECT_DOUBLE_EQ(distance.diagonal, width * std::sqrt(2.0));
}

TEST(SurfaceDistance, IsTheLargerOfBothDirections) {
  const TriangleMesh whole = test::grid(10, 10), half = test::grid(5, 10);
  const double rms = std::sqrt(5.0 * 5.0 * 5.0 / (3.0 * 10.0));
  const SurfaceDistance distance = compare_surfaces(half, whole, quick);
  EXPECT_LT(distance.from_reference.rms, 1e-12);
  EXPECT_NEAR(distance.from_test.rms, rms, 0.01 * rms);
  EXPECT_EQ(distance.symmetric.rms, distance.from_test.rms);
  EXPECT_DOUBLE_EQ(distance.symmetric.maximum, 5.0);
}

TEST(SurfaceDistance, SeesNormalsThatTurn) {
  const TriangleMesh flat = test::grid(4, 4);
  TriangleMesh flipped = flat;
  for (Triangle& t : flipped.triangles) std::swap(t[0], t[1]);
  EXPECT_NEAR(compare_surfaces(flat, flipped, quick).symmetric.normal_mean_degrees, 180.0, 1e-9);
  const Eigen::AngleAxisd tilt(0.1, Eigen::Vector3d::UnitX());
  const SurfaceDistance tilted = compare_surfaces(flat, moved(flat, Eigen::Affine3d(tilt)), quick);
  EXPECT_NEAR(tilted.symmetric.normal_mean_degrees, 0.1 * 180.0 / std::numbers::pi, 1e-9);
}

TEST(SurfaceDistance, OfASurfaceToItselfIsNothing) {
  const TriangleMesh mesh = test::add_bumps(test::sphere(3), 0.05, 3.0);
  const SurfaceDistance distance = compare_surfaces(mesh, mesh, quick);
  EXPECT_LT(distance.relative_hausdorff(), 1e-15);
}

TEST(SurfaceDistance, DoesNotDependOnThreadsOrDirtByOneBit) {
  const TriangleMesh a = test::sphere(4), b = test::add_noise(test::sphere(3), 0.3, 5);
  TriangleMesh dirty = b;
  dirty.positions.push_back({50, 50, 50});  // used by triangles of no area only
  const auto far = static_cast<std::uint32_t>(b.positions.size());
  dirty.triangles.insert(dirty.triangles.begin() + 7, {0, far, far});
  dirty.triangles.push_back({far, far, far});

  DistanceOptions options = quick;
  const SurfaceDistance once = compare_surfaces(a, b, options);
  const SurfaceDistance with_dirt = compare_surfaces(a, dirty, options);
  options.threads = 2;
  const SurfaceDistance threaded = compare_surfaces(SurfaceIndex(a), b, options);
  EXPECT_EQ(std::memcmp(&once, &threaded, sizeof once), 0);
  EXPECT_EQ(std::memcmp(&once, &with_dirt, sizeof once), 0);
  EXPECT_GT(once.symmetric.rms, 0.0);
}

TEST(SurfaceDistance, RefusesToMeasureNothing) {
  const TriangleMesh mesh = test::tetrahedron();
  EXPECT_THROW(compare_surfaces(mesh, TriangleMesh{}, quick), Error);
  EXPECT_THROW(compare_surfaces(TriangleMesh{}, mesh, quick), Error);
  EXPECT_THROW(compare_surfaces(mesh, mesh, {.samples = 0}), Error);
  EXPECT_THROW(compare_surfaces(mesh, mesh, {.threads = -1}), Error);
}

// Each triangle receives its share of the area, whatever their sizes.
TEST(SurfaceSamples, AreUniformOverTheArea) {
  TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {9, 0, 0}, {9, 9, 0}}, {}};
  mesh.triangles = {{0, 1, 2}, {1, 1, 2}, {1, 3, 4}};  // areas 0.5, 0, 36
  const SurfaceSamples samples(mesh, 7300);
  std::array<int, 3> counts{};
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const SurfaceSample& sample : samples.range(0, samples.size())) {
    ++counts[sample.triangle];
    if (sample.triangle == 2) sum += sample.position;
  }
  EXPECT_EQ(counts, (std::array<int, 3>{100, 0, 7200}));
  EXPECT_NEAR((sum / 7200 - Eigen::Vector3d(19.0 / 3, 3, 0)).norm(), 0.0, 0.01);
}

}  // namespace
}  // namespace zerotree::measure
