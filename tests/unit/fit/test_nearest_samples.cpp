// Nearest points that are followed from triangle to triangle, against those of a search tree.
#include "fit/nearest_samples.h"

#include <gtest/gtest.h>

#include <cmath>

#include "fit_shapes.h"
#include "measure/surface_index.h"
#include "relax/surface_relaxation.h"
#include "scans.h"

namespace zerotree::test {
namespace {

using Eigen::Vector3d;

/// A scan and its relaxed mesh, from which the search starts.
struct Remeshed {
  explicit Remeshed(const Scan& scan)
      : domain(domain::build_domain(scan.mesh, scan.options, {})),
        laid_out(remesh::remesh(domain, {.levels = 3}, {}).laid_out),
        relaxed(relax::relax(domain, laid_out, 3, {}, {})) {}
  relax::InputSurface input() const { return {domain.mesh, laid_out.charts.topology}; }
  const relax::SubdividedLevel& finest() const { return relaxed.levels.back(); }

  domain::Domain domain;
  remesh::Parameterisation laid_out;
  relax::RelaxedMesh relaxed;
};

/// The share of the samples that are as near as any point of the mesh; the others are held up by
/// sharp folds. None may be nearer.
double share_of_nearest(const Remeshed& remeshed, const fit::Points& limit,
                        const std::vector<fit::InputSample>& samples) {
  const TriangleMesh mesh{limit, remeshed.finest().triangles};
  const measure::SurfaceIndex index(mesh, 1);
  const double tolerance = 1e-5 * bounding_box_diagonal(limit);
  std::size_t nearest = 0;
  for (std::size_t v = 0; v < samples.size(); ++v) {
    const Triangle& t = mesh.triangles[samples[v].triangle];
    const Vector3d w = samples[v].corner_weights.cast<double>();
    EXPECT_GE(w.minCoeff(), 0);
    EXPECT_NEAR(w.sum(), 1, 1e-6);
    const Vector3d at = w[0] * limit[t[0]] + w[1] * limit[t[1]] + w[2] * limit[t[2]];
    const Vector3d& p = remeshed.domain.mesh.positions[v];
    const double least = std::sqrt(index.closest(p).distance_squared);
    EXPECT_GE((at - p).norm(), least - tolerance);
    nearest += (at - p).norm() <= least + tolerance ? 1 : 0;
  }
  return static_cast<double>(nearest) / static_cast<double>(samples.size());
}

TEST(NearestSamples, AreMostlyTheNearestOfAll) {
  for (const Scan& scan : scans()) {
    const Remeshed remeshed(scan);
    fit::NearestSamples nearest(remeshed.input(), remeshed.finest(), remeshed.relaxed.points);
    fit::Points limit = remeshed.relaxed.mesh.positions;
    EXPECT_GT(share_of_nearest(remeshed, limit, nearest.follow(limit)), 0.93) << scan.name;
    // They go on when the mesh moves.
    const double step = 0.003 * bounding_box_diagonal(limit);
    const fit::Points noise = random_points(limit.size(), 3);
    for (std::size_t v = 0; v < limit.size(); ++v)
      limit[v] += step * (noise[v] + Vector3d(1, 1, 1));
    EXPECT_GT(share_of_nearest(remeshed, limit, nearest.follow(limit)), 0.9) << scan.name;
  }
}

TEST(NearestSamples, HaveTheWeightsOfTheirAreas) {
  const Scan scan{"grid", midpoint_subdivide(grid(4, 3), 2), {}};
  const Remeshed remeshed(scan);
  fit::NearestSamples nearest(remeshed.input(), remeshed.finest(), remeshed.relaxed.points);
  double sum = 0, least = 1e9, most = 0;
  for (const fit::InputSample& sample : nearest.follow(remeshed.relaxed.mesh.positions)) {
    const auto weight = static_cast<double>(sample.weight);
    sum += weight;
    least = std::min(least, weight);
    most = std::max(most, weight);
  }
  EXPECT_NEAR(sum, remeshed.finest().vertex_count, 1e-3 * sum);
  EXPECT_NEAR(most / least, 6, 1e-3);  // an inner vertex has six faces, a corner may have one
}

// A mesh that is turned inside out is no place for the input's vertices.
TEST(NearestSamples, OnTheWrongSideHaveNoWeight) {
  const Scan scan{"sphere", sphere(3), {20, 180, {}}};
  const Remeshed remeshed(scan);
  fit::NearestSamples nearest(remeshed.input(), remeshed.finest(), remeshed.relaxed.points);
  fit::Points mirrored = remeshed.relaxed.mesh.positions;
  for (Vector3d& p : mirrored) p.x() = -p.x();
  for (const fit::InputSample& sample : nearest.follow(mirrored)) EXPECT_EQ(sample.weight, 0);
}

}  // namespace
}  // namespace zerotree::test
