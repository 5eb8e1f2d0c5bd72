// The penalty on the finest details.
#include "fit/smoothness_penalty.h"

#include <gtest/gtest.h>

#include <cmath>

#include "fit_shapes.h"

namespace zerotree::test {
namespace {

using Eigen::Vector3d;
using fit::Points;
using fit::SmoothnessPenalty;

/// A shape subdivided twice, its vertices at the edges' midpoints.
struct Surface {
  explicit Surface(const Shape& shape)
      : levels(relax::subdivide_base(topology_of(shape), 2)), positions(shape.mesh.positions) {
    for (int l = 0; l < 2; ++l)
      for (const auto& [a, b] : levels[static_cast<std::size_t>(l)].edges)
        positions.push_back((positions[a] + positions[b]) / 2);
    normals = random_points(positions.size(), 77);
  }
  SmoothnessPenalty penalty(const Shape& shape) const {
    return {topology_of(shape), levels[1], normals, positions, {0.3, 1.7}};
  }

  std::vector<relax::SubdividedLevel> levels;
  Points positions, normals;
};

Points gradient_of(const SmoothnessPenalty& penalty, const Points& points) {
  Points gradient(points.size(), Vector3d::Zero());
  penalty.add_gradient(1, points, gradient);
  return gradient;
}

class SmoothnessPenaltyOf : public testing::TestWithParam<Shape> {};

TEST_P(SmoothnessPenaltyOf, TranslationsIsZero) {
  const Surface surface(GetParam());
  const Points shift(surface.positions.size(), Vector3d(3, -2, 5));
  for (const Vector3d& g : gradient_of(surface.penalty(GetParam()), shift))
    EXPECT_LT(g.norm(), 1e-6);
}

TEST_P(SmoothnessPenaltyOf, AnyPointsIsSymmetricAndNotNegative) {
  const Surface surface(GetParam());
  const SmoothnessPenalty penalty = surface.penalty(GetParam());
  for (const std::uint32_t seed : {1u, 2u, 3u}) {
    const Points x = random_points(surface.positions.size(), seed);
    const Points y = random_points(surface.positions.size(), seed + 100);
    const Points hx = gradient_of(penalty, x), hy = gradient_of(penalty, y);
    EXPECT_NEAR(dot(hx, y), dot(x, hy), 1e-12 * std::sqrt(dot(hx, hx) * dot(y, y)));
    EXPECT_GE(dot(hx, x), 0);
    Points sum = hx;
    penalty.add_gradient(-1, x, sum);
    EXPECT_LT(std::sqrt(dot(sum, sum)), 1e-12 * (1 + std::sqrt(dot(hx, hx))));
  }
}

// A bound of each diagonal entry, on every axis, and of no more than the axes' ratio.
TEST_P(SmoothnessPenaltyOf, UnitVectorsIsBoundedByTheDiagonal) {
  const Surface surface(GetParam());
  const SmoothnessPenalty penalty = surface.penalty(GetParam());
  std::vector<double> diagonal(surface.positions.size(), 0.0);
  penalty.add_diagonal(diagonal);
  for (std::size_t v = 0; v < diagonal.size(); ++v) {
    double sum = 0;
    for (int axis = 0; axis < 3; ++axis) {
      Points unit(diagonal.size(), Vector3d::Zero());
      unit[v] = Vector3d::Unit(axis);
      const double entry = gradient_of(penalty, unit)[v][axis];
      EXPECT_LE(entry, diagonal[v] * (1 + 1e-6));
      sum += entry;
    }
    EXPECT_GE(sum, diagonal[v] * (1 - 1e-6));
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, SmoothnessPenaltyOf, testing::ValuesIn(tagged_shapes()),
                         [](const auto& shape) { return shape.param.name; });

/// A grid with a crease along x = 3 and corners where its outline turns.
Shape creased_grid() {
  Shape shape{"grid", grid(6, 4), {}, {0, 6, 28, 34}};
  for (std::uint32_t y = 0; y < 4; ++y) shape.crease_edges.push_back({7 * y + 3, 7 * y + 10});
  return shape;
}

// In the middle, along creases and boundaries, at corners.
TEST(SmoothnessPenalty, IsZeroOnLinearFunctions) {
  const Shape shape = creased_grid();
  const Surface surface(shape);
  Eigen::Matrix3d linear;
  linear << 1.0, 0.5, -0.25, 0.0, 2.0, 0.75, -1.0, 0.25, 1.0;
  Points points = surface.positions;
  for (Vector3d& p : points) p = linear * p + Vector3d(1, 2, 3);
  for (const Vector3d& g : gradient_of(surface.penalty(shape), points)) EXPECT_LT(g.norm(), 1e-6);
}

TEST(SmoothnessPenalty, DoesNotStraddleCreases) {
  const Shape shape = creased_grid();
  const Surface surface(shape);
  const SmoothnessPenalty penalty = surface.penalty(shape);
  const Points random = random_points(surface.positions.size(), 8);
  Points one_side = surface.positions, all = surface.positions;
  for (std::size_t v = 0; v < random.size(); ++v) {
    all[v] += random[v];
    if (surface.positions[v].x() <= 3) one_side[v] += random[v];
  }
  const Points of_one = gradient_of(penalty, one_side), of_all = gradient_of(penalty, all);
  int differ = 0;
  for (std::size_t v = 0; v < random.size(); ++v) {
    if (surface.positions[v].x() < 3) {
      EXPECT_EQ(of_one[v], of_all[v]);
    }
    differ += of_one[v] != of_all[v];
  }
  EXPECT_GT(differ, 50);
}

// What lies round a corner does not bend the curve before it, tagged or the end of a single face.
TEST(SmoothnessPenalty, DoesNotGoRoundCorners) {
  const Shape shape = creased_grid();
  const Surface surface(shape);
  const SmoothnessPenalty penalty = surface.penalty(shape);
  Points points = surface.positions;
  // The outline's piece x = 0 wanders off; y = 0 does not mind.
  for (std::size_t v = 0; v < points.size(); ++v)
    if (surface.positions[v].x() == 0 && surface.positions[v].y() > 0) points[v].z() += 1;
  const Points gradient = gradient_of(penalty, points);
  for (std::size_t v = 0; v < points.size(); ++v)
    if (surface.positions[v].y() == 0 && surface.positions[v].x() > 1) {
      EXPECT_LT(gradient[v].norm(), 1e-6) << surface.positions[v].transpose();
    }
}

}  // namespace
}  // namespace zerotree::test
