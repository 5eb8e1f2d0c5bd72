// The fit brings the limit surface close to the input.
#include "fit/surface_fit.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "measure/surface_distance.h"
#include "scans.h"

namespace zerotree::test {
namespace {

using Eigen::Vector3d;
using fit::Points;

/// A scan and its relaxed mesh.
struct Remeshed {
  Remeshed(const TriangleMesh& mesh, const domain::DomainOptions& options, int levels)
      : domain(domain::build_domain(mesh, options, {})),
        laid_out(remesh::remesh(domain, {.levels = levels}, {}).laid_out),
        relaxed(relax::relax(domain, laid_out, levels, {}, {})) {}

  Points fitted() const {
    return fit::fit_control_points(domain, laid_out, relaxed, {}, {}).points;
  }
  Points limit_of(const Points& points) const {
    Points limit;
    fit::LimitOperator(relaxed.mesh.base, relaxed.levels.back()).apply(points, limit);
    return limit;
  }
  double distance(const Points& points) const {
    return measure::compare_surfaces(domain.mesh,
                                     {limit_of(points), relaxed.levels.back().triangles},
                                     {.samples = 50'000, .threads = 1})
        .relative_rms();
  }

  domain::Domain domain;
  remesh::Parameterisation laid_out;
  relax::RelaxedMesh relaxed;
};

domain::DomainOptions smooth_options(std::uint32_t base_vertices) {
  return {.base_vertices = base_vertices, .crease_angle_degrees = 180, .pinned_vertices = {}};
}

TEST(SurfaceFit, HalvesTheDistanceOfABumpySphere) {
  const Remeshed sphere(add_bumps(test::sphere(5), 0.03, 3.0), smooth_options(20), 4);
  const double before = sphere.distance(sphere.relaxed.mesh.positions);
  const double after = sphere.distance(sphere.fitted());
  EXPECT_LT(after, 0.5 * before);
}

TEST(SurfaceFit, IsNoWorseOnAnyClass) {
  for (const Scan& scan : scans()) {
    const Remeshed remeshed(scan.mesh, scan.options, 3);
    const Points fitted = remeshed.fitted();
    // Flat faces are met exactly from the start: there the penalty may cost a little.
    EXPECT_LT(remeshed.distance(fitted),
              std::max(remeshed.distance(remeshed.relaxed.mesh.positions), 2e-4))
        << scan.name;
    for (const Vector3d& p : fitted) ASSERT_TRUE(p.allFinite());
  }
}

TEST(SurfaceFit, KeepsFeaturesInPlace) {
  const TriangleMesh cube = midpoint_subdivide(voxel_surface({{0, 0, 0}}), 4);
  const Remeshed remeshed(cube, {}, 3);
  const Points limit = remeshed.limit_of(remeshed.fitted());
  ASSERT_EQ(remeshed.laid_out.base.topology.corner_vertices.size(), 8u);
  // On a corner so many coordinates are whole, on an edge, on a face.
  const auto off = [](const Vector3d& p, int whole) {
    std::array<double, 3> miss{};
    for (int axis = 0; axis < 3; ++axis)
      miss[static_cast<std::size_t>(axis)] = std::abs(p[axis] - std::round(p[axis]));
    std::ranges::sort(miss);
    return miss[static_cast<std::size_t>(whole - 1)];
  };
  for (const std::uint32_t v : remeshed.laid_out.base.topology.corner_vertices)
    EXPECT_LT(off(limit[v], 3), 2e-3);
  const relax::SubdividedLevel& finest = remeshed.relaxed.levels.back();
  for (std::size_t e = 0; e < finest.edges.size(); ++e)
    for (const std::uint32_t v : finest.edges[e])
      EXPECT_LT(off(limit[v], finest.is_feature[e] ? 2 : 1), 6e-3);
}

TEST(SurfaceFit, KeepsBoundariesInPlace) {
  const Remeshed sheet(midpoint_subdivide(grid(4, 3), 3), {}, 3);
  const Points limit = sheet.limit_of(sheet.fitted());
  const relax::SubdividedLevel& finest = sheet.relaxed.levels.back();
  for (std::size_t e = 0; e < finest.edges.size(); ++e) {
    if (!finest.is_feature[e]) continue;
    for (const std::uint32_t v : finest.edges[e]) {
      const Vector3d& p = limit[v];
      const double off =
          std::min({std::abs(p.x()), std::abs(p.y()), std::abs(p.x() - 4), std::abs(p.y() - 3)});
      EXPECT_LT(off, 1e-2) << p.transpose();
      EXPECT_NEAR(p.z(), 0, 1e-9);
    }
  }
}

TEST(SurfaceFit, IsTheSameForAnyNumberOfThreads) {
  const Remeshed sphere(add_noise(test::sphere(5), 0.1, 3), smooth_options(30), 4);
  const auto with_threads = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return sphere.fitted();
  };
  EXPECT_EQ(with_threads(1), with_threads(2));
}

}  // namespace
}  // namespace zerotree::test
