// Minimising by limited-memory BFGS.
#include "fit/limited_memory_bfgs.h"

#include <gtest/gtest.h>

#include <cmath>

namespace zerotree::test {
namespace {

using Eigen::Vector3d;
using fit::Points;

// Rosenbrock's valley along x and y of every point, a bowl along z.
double valley(const Points& points, Points& gradient) {
  double sum = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double x = points[i].x(), y = points[i].y(), z = points[i].z();
    const double off = y - x * x;
    sum += (1 - x) * (1 - x) + 100 * off * off + z * z;
    gradient[i] = {-2 * (1 - x) - 400 * x * off, 200 * off, 2 * z};
  }
  return sum;
}

TEST(LimitedMemoryBfgs, FindsTheEndOfACurvedValley) {
  Points points{{-1.2, 1, 3}, {0, 0, -2}};
  const double energy = fit::minimise(valley, 200, 0.5, points);
  EXPECT_LT(energy, 1e-12);
  for (const Vector3d& p : points) EXPECT_LT((p - Vector3d(1, 1, 0)).norm(), 1e-5);
}

TEST(LimitedMemoryBfgs, NeverGoesUpOrTooFar) {
  Points points{{-1.2, 1, 3}};
  Points gradient(1);
  double last = valley(points, gradient);
  for (int i = 0; i < 40; ++i) {
    const Vector3d before = points[0];
    const double energy = fit::minimise(valley, 1, 0.01, points);
    EXPECT_LE(energy, last);
    EXPECT_LE((points[0] - before).norm(), 0.01 * (1 + 1e-9));
    EXPECT_DOUBLE_EQ(energy, valley(points, gradient));
    last = energy;
  }
}

TEST(LimitedMemoryBfgs, StaysAtAMinimum) {
  Points points{{1, 1, 0}};
  EXPECT_EQ(fit::minimise(valley, 10, 0.5, points), 0);
  EXPECT_EQ(points[0], Vector3d(1, 1, 0));
}

}  // namespace
}  // namespace zerotree::test
