// Spikes of the fitted surface are drawn in.
#include "fit/stray_faces.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "fitted_mesh.h"

namespace zerotree::test {
namespace {

using Eigen::Vector3d;
using fit::Points;

constexpr std::size_t kThrown = 100;  // a vertex, thrown by this vector
const Vector3d kThrow(3, 2, -1);

std::uint32_t draw_in(const Fitted& surface, Points& points) {
  const relax::InputSurface input = surface.input();
  std::vector<relax::SurfacePoint> feet = surface.relaxed.points;
  return fit::draw_in_stray_faces(fit::InputOrientation(input), surface.finest(), surface.limit,
                                  feet, points);
}

const Fitted& bumpy_sphere() {
  static const Fitted sphere(add_bumps(test::sphere(4), 0.01, 2.0), {20, 180, {}});
  return sphere;
}

TEST(StrayFaces, AreDrawnIn) {
  const Fitted& sphere = bumpy_sphere();
  Points points = sphere.points;
  points[kThrown] += kThrow;
  EXPECT_GT(draw_in(sphere, points), 0u);
  EXPECT_LT((points[kThrown] - sphere.points[kThrown]).norm(), 0.25 * kThrow.norm());
  // What lies elsewhere stays.
  std::size_t moved = 0;
  for (std::size_t v = 0; v < points.size(); ++v) moved += points[v] != sphere.points[v];
  EXPECT_LT(moved, 40u);
}

TEST(StrayFaces, AreNoneOnAGoodFit) {
  for (const Scan& scan : scans()) {
    const Fitted surface(scan.mesh, scan.options);
    Points points = surface.points;
    EXPECT_EQ(draw_in(surface, points), 0u) << scan.name;
    EXPECT_EQ(points, surface.points) << scan.name;
  }
}

}  // namespace
}  // namespace zerotree::test
