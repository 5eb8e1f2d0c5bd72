// Where limit vertices have their feet on the input, and what these count.
#include "fit/foot_targets.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "fit_shapes.h"
#include "fitted_mesh.h"

namespace zerotree::test {
namespace {

using Eigen::Vector3d;
using fit::FootTarget;
using fit::Points;

std::vector<FootTarget> feet_of(const Fitted& surface, const Points& limit) {
  const relax::InputSurface input = surface.input();
  std::vector<relax::SurfacePoint> points = surface.relaxed.points;
  return fit::follow_feet(input, surface.domain, surface.finest(), limit, points);
}

TEST(FootTargets, AreAboutAsFarAsTheInput) {
  for (const Scan& scan : scans()) {
    const Fitted surface(scan.mesh, scan.options);
    Points limit = surface.relaxed.mesh.positions;  // on the input
    const double step = 0.002 * bounding_box_diagonal(limit);
    const Points noise = random_points(limit.size(), 7);
    for (std::size_t v = 0; v < limit.size(); ++v) limit[v] += step * noise[v];
    const std::vector<FootTarget> feet = feet_of(surface, limit);
    for (std::size_t v = 0; v < limit.size(); ++v)
      EXPECT_LE((feet[v].position - limit[v]).norm(), 2 * step * noise[v].norm() + 1e-9)
          << scan.name;  // a walk may go a little far round a bend
  }
}

TEST(FootTargets, CountMoreOnFeaturesAndAtLeastAFifthInTinyFaces) {
  const Scan creased{"creased", midpoint_subdivide(voxel_surface({{0, 0, 0}}), 3), {}};
  const Fitted surface(creased.mesh, creased.options);
  Points limit = surface.relaxed.mesh.positions;
  // The faces around a vertex inside a face of the cube shrink to nothing.
  std::uint32_t inside = 0;
  while (surface.held[inside]) ++inside;
  for (const auto& [a, b] : surface.finest().edges) {
    if (a == inside) limit[b] = limit[inside];
    if (b == inside) limit[a] = limit[inside];
  }
  const std::vector<FootTarget> feet = feet_of(surface, limit);
  EXPECT_NEAR(static_cast<double>(feet[inside].weight), 0.2, 1e-6);
  double on_features = 0, off_features = 0;
  int features = 0;
  for (const FootTarget& foot : feet) {
    EXPECT_GE(foot.weight, 0.2f - 1e-6f);
    (foot.is_on_feature() ? on_features : off_features) += static_cast<double>(foot.weight);
    features += foot.is_on_feature() ? 1 : 0;
  }
  ASSERT_GT(features, 0);
  const double others = static_cast<double>(feet.size()) - features;
  EXPECT_GT(on_features / features, 4 * off_features / others);
}

}  // namespace
}  // namespace zerotree::test
