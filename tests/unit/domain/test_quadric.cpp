// Quadrics about moving places still give squared distances from their planes.
#include "domain/quadric.h"

#include <gtest/gtest.h>

namespace zerotree::domain {
namespace {

TEST(Quadric, IsZeroOnItsPlanes) {
  Quadric quadric;
  quadric.add_plane({0, 0, 1}, 2);
  EXPECT_EQ(quadric.at({3, 4, 0}), 0);
  EXPECT_NEAR(quadric.at({3, 4, 0.5}), 2 * 0.25, 1e-7);
  EXPECT_NEAR(quadric.weight(), 2, 1e-7);
}

// Far from the origin of a chain of merges, nothing is lost to cancellation.
TEST(Quadric, AddsTheDistancesOfOtherVertices) {
  const Eigen::Vector3d normal = Eigen::Vector3d(1, 2, 3).normalized();
  const Eigen::Vector3d first(0, 0, 0), second(0.4, -0.2, 0.1), third(0.3, 0.3, -0.6);
  Quadric a, b, c;
  a.add_plane(normal, 1);
  b.add_plane({0, 1, 0}, 0.5);
  c.add_plane({0, 0, 1}, 3);
  b.add(a, second - first);
  c.add(b, third - second);
  const Eigen::Vector3d p(0.31, 0.29, -0.58);
  const auto squared = [](double x) { return x * x; };
  const double expected = squared(normal.dot(p - first)) + 0.5 * squared((p - second).y()) +
                          3 * squared((p - third).z());
  EXPECT_NEAR(c.at(p - third), expected, 1e-6 * expected);
}

}  // namespace
}  // namespace zerotree::domain
