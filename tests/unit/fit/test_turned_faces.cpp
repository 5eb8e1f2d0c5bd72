// Turned faces are found and turned back.
#include "fit/turned_faces.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>

#include "fitted_mesh.h"

namespace zerotree::test {
namespace {

using Eigen::Vector3d;
using fit::Points;

/// Two neighbours of each of some faces change places: what lies between them is folded.
Points folded(const Fitted& surface) {
  Points points = surface.points;
  const std::vector<Triangle>& triangles = surface.finest().triangles;
  for (std::size_t f = 10; f < triangles.size(); f += triangles.size() / 8) {
    const auto [a, b, c] = triangles[f];
    if (!surface.held[a] && !surface.held[b]) {
      const Vector3d over = 1.5 * (points[b] - points[a]);
      points[a] += over;
      points[b] -= over;
    }
  }
  return points;
}

double largest_change(const Points& a, const Points& b) {
  double largest = 0;
  for (std::size_t v = 0; v < a.size(); ++v) largest = std::max(largest, (a[v] - b[v]).norm());
  return largest;
}

TEST(TurnedFaces, LeavesASurfaceWithoutThemAlone) {
  const Fitted sphere(add_bumps(test::sphere(4), 0.02, 2.0),
                      {.base_vertices = 20, .crease_angle_degrees = 180, .pinned_vertices = {}});
  Points points = sphere.points;
  EXPECT_EQ(sphere.turn_back(points), 0u);
  EXPECT_EQ(points, sphere.points);
}

TEST(TurnedFaces, TurnsFoldsBackOntoTheInput) {
  const Fitted sphere(test::sphere(4),
                      {.base_vertices = 20, .crease_angle_degrees = 180, .pinned_vertices = {}});
  Points points = folded(sphere);
  ASSERT_GT(sphere.count_turned(points), 8);
  EXPECT_EQ(sphere.turn_back(points), 0u);
  EXPECT_EQ(sphere.count_turned(points), 0);
  Points at;
  sphere.limit.apply(points, at);
  for (const Vector3d& p : at) EXPECT_NEAR(p.norm(), 1, 0.01);
}

// Nothing crosses the creases or moves on them.
TEST(TurnedFaces, TurnsFoldsBackBesideCreases) {
  const Fitted cube(midpoint_subdivide(voxel_surface({{0, 0, 0}}), 4), {});
  Points points = cube.points;
  // The vertices beside creases go over them.
  for (const auto& [a, b] : cube.finest().edges)
    if (cube.held[a] && !cube.held[b] && b % 5 == 0) points[b] += 2 * (points[a] - points[b]);
  const Points before = points;
  ASSERT_GT(cube.count_turned(points), 8);
  EXPECT_EQ(cube.turn_back(points), 0u);
  Points at;
  cube.limit.apply(points, at);
  for (std::size_t v = 0; v < at.size(); ++v) {
    if (cube.held[v]) {
      EXPECT_EQ(points[v], before[v]);
    }
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_GT(at[v][axis], -0.02);
      EXPECT_LT(at[v][axis], 1.02);
    }
  }
}

TEST(TurnedFaces, IsTheSameForAnyNumberOfThreads) {
  const Fitted sphere(test::sphere(4),
                      {.base_vertices = 20, .crease_angle_degrees = 180, .pinned_vertices = {}});
  const auto with_threads = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    Points points = folded(sphere);
    sphere.turn_back(points);
    return points;
  };
  EXPECT_EQ(largest_change(with_threads(1), with_threads(2)), 0);
}

// A face seen from inside is turned, on a plane and beside its edge.
TEST(InputOrientation, ComparesFacesWithTheInputBesideThem) {
  const Fitted cube(midpoint_subdivide(voxel_surface({{0, 0, 0}}), 4), {});
  const relax::InputSurface surface = cube.input();
  const fit::InputOrientation orientation(surface);
  Points at;
  cube.limit.apply(cube.points, at);
  for (const auto& [a, b, c] : cube.finest().triangles) {
    if (cube.held[a] && cube.held[b] && cube.held[c]) continue;
    EXPECT_FALSE(orientation.is_turned(cube.relaxed.points, at, {a, b, c}));
    EXPECT_TRUE(orientation.is_turned(cube.relaxed.points, at, {a, c, b}));
  }
}

}  // namespace
}  // namespace zerotree::test
