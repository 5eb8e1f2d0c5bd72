// Analysis and the runtime's synthesis undo each other.
#include "analysis/wavelet_analysis.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "mesh/error.h"
#include "mesh/triangle_mesh.h"
#include "surface/surface_synthesis.h"
#include "torus_base.h"

namespace zerotree::test {
namespace {

using analysis::WaveletDecomposition;
using surface::SubdivisionHierarchy;

constexpr int kLevels = 3;

/// The base subdivided to `hierarchy`'s finest level by Loop and shaken.
std::vector<Eigen::Vector3d> shaken_points(const SubdivisionHierarchy& hierarchy,
                                           const TriangleMesh& base, double amplitude) {
  surface::Positions points;
  for (const Eigen::Vector3d& p : base.positions)
    for (int axis = 0; axis < 3; ++axis) points.push_back(static_cast<float>(p[axis]));
  for (int number = 0; number < hierarchy.levels(); ++number)
    points = surface::subdivide(hierarchy.level(number), points);
  std::mt19937 random(11);
  std::uniform_real_distribution<double> shake(-amplitude, amplitude);
  std::vector<Eigen::Vector3d> shaken;
  for (std::size_t k = 0; k < points.size(); k += 3)
    shaken.emplace_back(points[k] + shake(random), points[k + 1] + shake(random),
                        points[k + 2] + shake(random));
  return shaken;
}

/// What the runtime makes of unquantised details, in its own floats.
surface::Positions synthesise(const SubdivisionHierarchy& hierarchy,
                              const WaveletDecomposition& decomposition) {
  surface::Positions points;
  for (const Eigen::Vector3d& p : decomposition.base_control_points)
    for (int axis = 0; axis < 3; ++axis) points.push_back(static_cast<float>(p[axis]));
  for (int number = 0; number < hierarchy.levels(); ++number) {
    surface::LocalDetails details;
    for (const Eigen::Vector3d& d : decomposition.details[static_cast<std::size_t>(number)])
      for (int axis = 0; axis < 3; ++axis) details.push_back(static_cast<float>(d[axis]));
    surface::Positions fine = surface::subdivide(hierarchy.level(number), points);
    surface::add_details(hierarchy.level(number), details, fine);
    points = std::move(fine);
  }
  return points;
}

double largest_difference(const surface::Positions& ours,
                          const std::vector<Eigen::Vector3d>& expected) {
  double largest = 0.0;
  for (std::size_t v = 0; v < expected.size(); ++v)
    largest = std::max(
        largest,
        (Eigen::Vector3d(ours[3 * v], ours[3 * v + 1], ours[3 * v + 2]) - expected[v]).norm());
  return largest;
}

class WaveletAnalysis : public testing::TestWithParam<Shape> {};

TEST_P(WaveletAnalysis, IsUndoneBySynthesis) {
  const SubdivisionHierarchy hierarchy(topology_of(GetParam()), kLevels, kQuadratureMirror);
  const auto fine = shaken_points(hierarchy, GetParam().mesh, 0.03);
  const auto decomposition = analysis::analyse(hierarchy, fine, {}, {});
  EXPECT_LT(largest_difference(synthesise(hierarchy, decomposition), fine),
            1e-5 * bounding_box_diagonal(fine));
}

TEST_P(WaveletAnalysis, FindsNoDetailsInASmoothSurface) {
  const SubdivisionHierarchy hierarchy(topology_of(GetParam()), kLevels, kQuadratureMirror);
  const auto fine = shaken_points(hierarchy, GetParam().mesh, 0.0);
  const auto decomposition = analysis::analyse(hierarchy, fine, {}, {});
  for (const auto& level : decomposition.details)
    for (const Eigen::Vector3d& detail : level) EXPECT_LT(detail.norm(), 1e-5);
}

// The details come back that were put in: frames, signs and places agree with the runtime.
TEST_P(WaveletAnalysis, FindsTheDetailsThatWerePutIn) {
  const SubdivisionHierarchy hierarchy(topology_of(GetParam()), kLevels, kQuadratureMirror);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> length(-0.01, 0.01);
  WaveletDecomposition put_in;
  put_in.base_control_points = GetParam().mesh.positions;
  for (int number = 0; number < kLevels; ++number)
    for (auto& level = put_in.details.emplace_back();
         level.size() < hierarchy.level(number).edge_count;)
      level.emplace_back(length(random), length(random), length(random));
  const surface::Positions fine = synthesise(hierarchy, put_in);
  std::vector<Eigen::Vector3d> points;
  for (std::size_t k = 0; k < fine.size(); k += 3)
    points.emplace_back(fine[k], fine[k + 1], fine[k + 2]);
  const auto found = analysis::analyse(hierarchy, points, {}, {});
  for (std::size_t level = 0; level < kLevels; ++level)
    for (std::size_t edge = 0; edge < found.details[level].size(); ++edge)
      ASSERT_LT((found.details[level][edge] - put_in.details[level][edge]).norm(), 2e-4);
}

INSTANTIATE_TEST_SUITE_P(Shapes, WaveletAnalysis, testing::ValuesIn(base_shapes()),
                         [](const auto& shape) { return shape.param.name; });

TEST(WaveletAnalysis, DoesNotDependOnTheNumberOfThreads) {
  const Shape shape = base_shapes()[0];
  const SubdivisionHierarchy hierarchy(topology_of(shape), kLevels, kQuadratureMirror);
  const auto fine = shaken_points(hierarchy, shape.mesh, 0.05);
  analysis::AnalysisOptions three;
  three.threads = 3;
  const auto a = analysis::analyse(hierarchy, fine, {}, {});
  const auto b = analysis::analyse(hierarchy, fine, three, {});
  EXPECT_EQ(a.base_control_points, b.base_control_points);
  EXPECT_EQ(a.details, b.details);
}

TEST(WaveletAnalysis, RefusesWhatItCannotSplit) {
  const Shape shape = base_shapes()[0];
  const SubdivisionHierarchy hierarchy(topology_of(shape), 1, kQuadratureMirror);
  auto fine = shaken_points(hierarchy, shape.mesh, 0.05);
  analysis::AnalysisOptions hasty;
  hasty.most_iterations = 1;
  EXPECT_THROW(analysis::analyse(hierarchy, fine, hasty, {}), Error);
  fine[3][1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(analysis::analyse(hierarchy, fine, {}, {}), Error);
  fine.pop_back();
  EXPECT_THROW(analysis::analyse(hierarchy, fine, {}, {}), Error);
}

}  // namespace
}  // namespace zerotree::test
