#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "measure/closest_point_on_triangle.h"
#include "measure/surface_index.h"
#include "mesh/error.h"
#include "shapes.h"

namespace zerotree::measure {
namespace {

TriangleMesh moved(TriangleMesh mesh, double scale, const Eigen::Vector3d& offset) {
  for (Eigen::Vector3d& p : mesh.positions) p = scale * p + offset;
  return mesh;
}

SurfacePoint closest_of_all(const TriangleMesh& mesh, const Eigen::Vector3d& p) {
  SurfacePoint best;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const Eigen::Vector3d q =
        closest_point_on_triangle(p, mesh.positions[a], mesh.positions[b], mesh.positions[c]);
    const double d = (q - p).squaredNorm();
    if (d < best.distance_squared) best = {q, d, t};
  }
  return best;
}

// Points on, near and far from the mesh, in its own frame.
std::vector<Eigen::Vector3d> query_points(const TriangleMesh& mesh, double scale,
                                          const Eigen::Vector3d& offset) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::vector<Eigen::Vector3d> points(mesh.positions.begin(), mesh.positions.begin() + 40);
  for (double reach : {1.0, 1e-9, 1e-4, 1.5, 1000.0})
    for (int i = 0; i < 60; ++i) {
      Eigen::Vector3d p(uniform(random), uniform(random), uniform(random));
      p *= reach;
      if (reach < 1.0) p += p.normalized();  // near the unit sphere
      points.push_back(scale * p + offset);
    }
  return points;
}

class SurfaceIndexFrame : public testing::TestWithParam<std::pair<double, double>> {};

// The hierarchy is made of floats; the answer must be the double one, wherever the mesh lies.
TEST_P(SurfaceIndexFrame, FindsTheExactClosestPoint) {
  const auto [scale, shift] = GetParam();
  const Eigen::Vector3d offset(shift, -shift, 0.5 * shift);
  const TriangleMesh mesh = moved(test::sphere(3), scale, offset);
  const SurfaceIndex index(mesh);
  std::uint32_t hint = SurfacePoint::no_triangle;
  for (const Eigen::Vector3d& p : query_points(mesh, scale, offset)) {
    const SurfacePoint expected = closest_of_all(mesh, p);
    const SurfacePoint found = index.closest(p), hinted = index.closest(p, hint);
    ASSERT_EQ(found.distance_squared, expected.distance_squared) << p.transpose();
    ASSERT_EQ(found.triangle, expected.triangle) << p.transpose();
    ASSERT_EQ(hinted.distance_squared, expected.distance_squared) << p.transpose();
    ASSERT_EQ(hinted.triangle, expected.triangle) << p.transpose();
    hint = found.triangle;
  }
}

INSTANTIATE_TEST_SUITE_P(Frames, SurfaceIndexFrame,
                         testing::Values(std::pair{1.0, 0.0}, std::pair{1e-6, 0.0},
                                         std::pair{1e7, 3e6}, std::pair{1.0, 12345.678},
                                         std::pair{1e-3, 1000.0}));

TEST(SurfaceIndex, ClosestPointOfATriangleCoversAllItsRegions) {
  const Eigen::Vector3d a(0, 0, 0), b(2, 0, 0), c(0, 2, 0);
  const auto closest = [&](double x, double y) {
    return closest_point_on_triangle({x, y, 1}, a, b, c);
  };
  EXPECT_EQ(closest(-1, -1), a);
  EXPECT_EQ(closest(4, 1), b);
  EXPECT_EQ(closest(1, 4), c);
  EXPECT_EQ(closest(1, -1), Eigen::Vector3d(1, 0, 0));
  EXPECT_EQ(closest(-1, 1), Eigen::Vector3d(0, 1, 0));
  EXPECT_EQ(closest(2, 2), Eigen::Vector3d(1, 1, 0));
  EXPECT_EQ(closest(0.5, 0.5), Eigen::Vector3d(0.5, 0.5, 0));
}

TEST(SurfaceIndex, TrianglesWithoutAreaAreNotThere) {
  TriangleMesh mesh = test::grid(2, 2);
  const std::uint32_t far = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.push_back({100, 0, 0});
  mesh.triangles.push_back({0, far, far});
  mesh.triangles.push_back({0, 1, far});  // collinear with its first edge
  const SurfaceIndex index(mesh);
  EXPECT_DOUBLE_EQ(index.closest({100, 0, 0}).distance_squared, 98.0 * 98.0);
}

TEST(SurfaceIndex, RefusesWhatIsNoSurface) {
  TriangleMesh flat{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}}};
  EXPECT_THROW(SurfaceIndex{flat}, Error);
  EXPECT_THROW(SurfaceIndex{TriangleMesh{}}, Error);
  TriangleMesh out_of_range = test::tetrahedron();
  out_of_range.triangles[1][2] = 4;
  EXPECT_THROW(SurfaceIndex{out_of_range}, Error);
  TriangleMesh not_finite = test::tetrahedron();
  not_finite.positions[2].y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(SurfaceIndex{not_finite}, Error);
}

}  // namespace
}  // namespace zerotree::measure
