#include "convert/base_grid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace zerotree::convert {
namespace {

std::vector<Eigen::Vector3d> random_points(const Eigen::Vector3d& centre, double size) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> part(-0.5, 0.5);
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 500; ++i)
    points.push_back(centre + size * Eigen::Vector3d(part(random), part(random), part(random)));
  return points;
}

void expect_exact_enough(const Eigen::Vector3d& centre, double size) {
  const std::vector<Eigen::Vector3d> points = random_points(centre, size);
  const gltf::Placement grid = grid_for(points);
  EXPECT_GT(grid.scale, 0.9 * size / 65536);
  EXPECT_LT(grid.scale, 1.1 * size / 65536);
  const auto moved = on_grid({points, {{Eigen::Vector3d(size, 0, -2 * size)}}}, grid);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d& p = moved.base_control_points[i];
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_TRUE(p[axis] >= 0 && p[axis] <= 65535 && p[axis] == std::round(p[axis]));
      EXPECT_FALSE(std::signbit(p[axis]));
    }
    const Eigen::Vector3d error = grid.scale * p + grid.translation - points[i];
    EXPECT_LE(error.cwiseAbs().maxCoeff(), 0.501 * grid.scale);
  }
  EXPECT_NEAR(moved.details[0][0].z(), -2 * size / grid.scale, 1e-6 * size / grid.scale);
}

TEST(BaseGrid, HoldsPointsOfAnySizeAndPlace) {
  for (double size : {1e-6, 0.25, 3.0, 7e5}) {
    expect_exact_enough({0, 0, 0}, size);
    expect_exact_enough({-40 * size, 3 * size, 1000 * size}, size);
  }
}

TEST(BaseGrid, OfOnePointIsTheIdentity) {
  const gltf::Placement grid = grid_for({Eigen::Vector3d(1, 2, 3)});
  EXPECT_EQ(grid.scale, 1);
  EXPECT_TRUE(grid.translation.isZero());
}

}  // namespace
}  // namespace zerotree::convert
