#include <gtest/gtest.h>

#include "remesh/lattice_isometry.h"
#include "remesh/ring_kernel.h"
#include "remesh/stretch_energy.h"

namespace zerotree::remesh {
namespace {

Ring ring_of(const std::vector<Eigen::Vector2d>& points) {
  Ring ring;
  ring.points = points;
  for (const Eigen::Vector2d& p : points) ring.positions.emplace_back(p.x(), p.y(), 0);
  return ring;
}

TEST(RingKernel, OfASquareIsItsCentre) {
  const auto centroid = kernel_centroid(ring_of({{0, 0}, {1, 0}, {1, 1}, {0, 1}}));
  ASSERT_TRUE(centroid);
  EXPECT_NEAR((*centroid - Eigen::Vector2d(0.5, 0.5)).norm(), 0, 1e-12);
}

TEST(RingKernel, OfADeepNotchIsEmpty) {
  EXPECT_FALSE(
      kernel_centroid(ring_of({{0, 0}, {4, 0}, {4, 4}, {3, 4}, {3, 1}, {1, 1}, {1, 4}, {0, 4}})));
}

TEST(RingKernel, IntervalOnALine) {
  const auto interval =
      kernel_interval(ring_of({{0, 0}, {2, 0}, {2, 1}, {0, 1}}), {-1, 0.5}, {3, 0.5});
  ASSERT_TRUE(interval);
  EXPECT_NEAR((*interval)[0], 0.25, 1e-12);
  EXPECT_NEAR((*interval)[1], 0.75, 1e-12);
}

TEST(StretchEnergy, IsLeastWhereTheMapIsIsometric) {
  const Ring ring = ring_of({{1, 0}, {0.4, 1}, {-1, 0.6}, {-0.8, -0.9}, {0.5, -1}});
  StretchEnergy energy;
  energy.prepare(ring, {0.1, 0.05, 0});
  const Eigen::Vector2d p = minimise_in_plane(energy, ring, {-0.3, 0.2}, 30);
  EXPECT_NEAR((p - Eigen::Vector2d(0.1, 0.05)).norm(), 0, 2e-3);
}

TEST(StretchEnergy, HasTheDerivativesItSays) {
  const Ring ring = ring_of({{1, 0}, {0.4, 1}, {-1, 0.6}, {-0.8, -0.9}, {0.5, -1}});
  StretchEnergy energy;
  energy.prepare(ring, {0.2, 0.1, 0.3});
  const Eigen::Vector2d p(0.05, -0.1);
  const double h = 1e-5;
  const auto value = energy.evaluate(p);
  EXPECT_NEAR(value.energy, energy.energy(p), 1e-12 * value.energy);
  for (int axis = 0; axis < 2; ++axis) {
    const Eigen::Vector2d step = h * Eigen::Vector2d::Unit(axis);
    const auto after = energy.evaluate(p + step), before = energy.evaluate(p - step);
    EXPECT_NEAR((after.energy - before.energy) / (2 * h), value.gradient[axis], 1e-5);
    EXPECT_NEAR(((after.gradient - before.gradient) / (2 * h) - value.hessian.col(axis)).norm(), 0,
                1e-4);
  }
}

TEST(LatticeIsometry, ComposesAndInvertsExactly) {
  for (std::int16_t turns = 0; turns < 6; ++turns) {
    const LatticeIsometry a{3, -5, turns}, b{-2, 7, 4};
    EXPECT_EQ(compose(a, inverse(a)), LatticeIsometry{});
    EXPECT_EQ(compose(inverse(a), a), LatticeIsometry{});
    const LatticePoint p(0.25, 0.5);
    EXPECT_EQ(apply(compose(a, b), p), apply(a, apply(b, p)));
    const LatticePoint q = apply({0, 0, turns}, p);
    EXPECT_NEAR(to_plane(q).norm(), to_plane(p).norm(), 1e-15);
  }
}

}  // namespace
}  // namespace zerotree::remesh
