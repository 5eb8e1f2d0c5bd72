// Analysis and the runtime's synthesis undo each other.
#include "analysis/wavelet_analysis.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <tuple>

#include "analysis/local_details.h"
#include "mesh/error.h"
#include "mesh/triangle_mesh.h"
#include "surface/detail_weights.h"
#include "surface/edge_frames.h"
#include "surface/surface_synthesis.h"
#include "torus_base.h"

namespace zerotree::test {
namespace {

using analysis::WaveletDecomposition;
using surface::SubdivisionHierarchy;

constexpr int kLevels = 3;

std::vector<float> single_precision(const std::vector<Eigen::Vector3d>& vectors) {
  std::vector<float> result;
  for (const Eigen::Vector3d& v : vectors)
    for (int axis = 0; axis < 3; ++axis) result.push_back(static_cast<float>(v[axis]));
  return result;
}

/// The base subdivided to `hierarchy`'s finest level by Loop and shaken.
std::vector<Eigen::Vector3d> shaken_points(const SubdivisionHierarchy& hierarchy,
                                           const TriangleMesh& base, double amplitude) {
  surface::Positions points = single_precision(base.positions);
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
  surface::Positions points = single_precision(decomposition.base_control_points);
  for (int number = 0; number < hierarchy.levels(); ++number) {
    surface::Positions fine = surface::subdivide(hierarchy.level(number), points);
    surface::add_details(hierarchy.level(number),
                         single_precision(decomposition.details[static_cast<std::size_t>(number)]),
                         fine);
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

/// Those and one with darts and a corner inside.
std::vector<Shape> shapes() {
  std::vector<Shape> result = base_shapes();
  result.push_back({"darts", grid(4, 4), {{11, 12}, {12, 13}}, {6}});
  return result;
}

class WaveletAnalysis
    : public testing::TestWithParam<std::tuple<Shape, surface::WaveletTransform>> {
 protected:
  const Shape& shape() const { return std::get<0>(GetParam()); }
  SubdivisionHierarchy hierarchy() const {
    return {topology_of(shape()), kLevels, std::get<1>(GetParam())};
  }
};

TEST_P(WaveletAnalysis, IsUndoneBySynthesis) {
  const SubdivisionHierarchy hierarchy = this->hierarchy();
  const auto fine = shaken_points(hierarchy, shape().mesh, 0.03);
  const auto decomposition = analysis::analyse(hierarchy, fine, {}, {});
  EXPECT_LT(largest_difference(synthesise(hierarchy, decomposition), fine),
            1e-5 * bounding_box_diagonal(fine));
}

TEST_P(WaveletAnalysis, FindsNoDetailsInASmoothSurface) {
  const SubdivisionHierarchy hierarchy = this->hierarchy();
  const auto fine = shaken_points(hierarchy, shape().mesh, 0.0);
  const auto decomposition = analysis::analyse(hierarchy, fine, {}, {});
  for (const auto& level : decomposition.details)
    for (const Eigen::Vector3d& detail : level) EXPECT_LT(detail.norm(), 1e-5);
}

// The details come back that were put in: signs and places agree with the runtime.
TEST_P(WaveletAnalysis, FindsTheDetailsThatWerePutIn) {
  const SubdivisionHierarchy hierarchy = this->hierarchy();
  std::mt19937 random(3);
  std::uniform_real_distribution<double> length(-0.01, 0.01);
  WaveletDecomposition put_in;
  put_in.base_control_points = shape().mesh.positions;
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

// In frames they are as long, and the frames are those that the runtime puts them into.
TEST_P(WaveletAnalysis, DetailsInFramesAreThoseOfTheRuntime) {
  const SubdivisionHierarchy hierarchy = this->hierarchy();
  const auto fine = shaken_points(hierarchy, shape().mesh, 0.03);
  const auto decomposition = analysis::analyse(hierarchy, fine, {}, {});
  const auto local = analysis::local_details(hierarchy, decomposition);
  surface::Positions points = single_precision(decomposition.base_control_points);
  for (int number = 0; number < kLevels; ++number) {
    const surface::SubdivisionLevel& level = hierarchy.level(number);
    const auto& details = local[static_cast<std::size_t>(number)];
    surface::Positions predicted = surface::subdivide(level, points);
    surface::Moves moves = single_precision(details);
    // The weight is the only thing that stands between the two.
    for (std::size_t edge = 0; edge < level.edge_count; ++edge) {
      const double area =
          surface::edge_tangents(predicted.data(), level.vertex_count, level.edges.vertices[edge],
                                 level.edges.wings[edge])
              .triangle_area();
      for (std::size_t c = 0; c < 3; ++c) moves[3 * edge + c] *= surface::area_weight(area, 0.1);
    }
    moves = surface::detail_moves(level, moves, 0.1, predicted);
    const auto& global = decomposition.details[static_cast<std::size_t>(number)];
    for (std::size_t edge = 0; edge < level.edge_count; ++edge) {
      const Eigen::Vector3d move(moves[3 * edge], moves[3 * edge + 1], moves[3 * edge + 2]);
      ASSERT_LT((move - global[edge]).norm(), 1e-5);
      ASSERT_NEAR(details[edge].norm(), global[edge].norm(), 1e-9);
    }
    surface::add_details(level, single_precision(global), predicted);
    points = std::move(predicted);
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, WaveletAnalysis,
                         testing::Combine(testing::ValuesIn(shapes()),
                                          testing::ValuesIn(kTransforms)),
                         [](const auto& test) {
                           return std::get<0>(test.param).name + "_" +
                                  name_of(std::get<1>(test.param));
                         });

class AnyTransform : public testing::TestWithParam<surface::WaveletTransform> {};

TEST_P(AnyTransform, DoesNotDependOnTheNumberOfThreads) {
  const Shape shape = base_shapes()[0];
  const SubdivisionHierarchy hierarchy(topology_of(shape), kLevels, GetParam());
  const auto fine = shaken_points(hierarchy, shape.mesh, 0.05);
  analysis::AnalysisOptions three;
  three.threads = 3;
  const auto a = analysis::analyse(hierarchy, fine, {}, {});
  const auto b = analysis::analyse(hierarchy, fine, three, {});
  EXPECT_EQ(a.base_control_points, b.base_control_points);
  EXPECT_EQ(a.details, b.details);
}

TEST_P(AnyTransform, RefusesWhatItCannotSplit) {
  const Shape shape = base_shapes()[0];
  const SubdivisionHierarchy hierarchy(topology_of(shape), 1, GetParam());
  auto fine = shaken_points(hierarchy, shape.mesh, 0.05);
  analysis::AnalysisOptions hasty;
  hasty.most_iterations = 1;
  EXPECT_THROW(analysis::analyse(hierarchy, fine, hasty, {}), Error);
  fine[3][1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(analysis::analyse(hierarchy, fine, {}, {}), Error);
  fine.pop_back();
  EXPECT_THROW(analysis::analyse(hierarchy, fine, {}, {}), Error);
}

INSTANTIATE_TEST_SUITE_P(Transforms, AnyTransform, testing::ValuesIn(kTransforms),
                         [](const auto& test) { return name_of(test.param); });

}  // namespace
}  // namespace zerotree::test
