// The relaxed semi-regular mesh of each class of input.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <Eigen/Geometry>
#include <cmath>
#include <memory>

#include "clean/clean_mesh.h"
#include "input_curves.h"
#include "measure/surface_distance.h"
#include "relax/chart_orientation.h"
#include "relax/surface_relaxation.h"
#include "remesh/lattice_numbering.h"
#include "scans.h"

namespace zerotree::test {
namespace {

using Eigen::Vector3d;
using relax::RelaxedMesh;
using relax::SubdividedLevel;

constexpr int kLevels = 3;

/// A sphere as files come: no two faces share a vertex, some are doubled, turned or a line.
TriangleMesh dirty_sphere() {
  const TriangleMesh clean = add_noise(add_bumps(sphere(3), 0.02, 2.0), 0.1, 7);
  TriangleMesh soup;
  const auto add = [&](const Triangle& t) {
    const auto first = static_cast<std::uint32_t>(soup.positions.size());
    for (std::uint32_t v : t) soup.positions.push_back(clean.positions[v]);
    soup.triangles.push_back({first, first + 1, first + 2});
  };
  for (std::size_t f = 0; f < clean.triangles.size(); ++f) {
    const auto [a, b, c] = clean.triangles[f];
    add(f % 17 == 0 ? Triangle{a, c, b} : Triangle{a, b, c});
    if (f % 23 == 0) add({a, b, c});
    if (f % 29 == 0) add({a, b, a});
  }
  return soup;
}

std::vector<Scan> all_scans() {
  std::vector<Scan> all = scans();
  // Creases on a bent surface: a cube whose faces bulge.
  Scan bulging{"bulging_cube", midpoint_subdivide(voxel_surface({{0, 0, 0}}), 4), {}};
  for (Vector3d& p : bulging.mesh.positions) {
    const Vector3d q = p - Vector3d::Constant(0.5);
    p += 0.3 * (1 - q.squaredNorm()) * q + Vector3d(0.1 * p.y() * p.y(), 0, 0.05 * p.x() * p.y());
  }
  bulging.options.base_vertices = 24;
  all.push_back(std::move(bulging));
  Scan dirty{"dirty", clean::clean_mesh(dirty_sphere(), {}, {}).mesh, {}};
  dirty.options.base_vertices = 20;
  dirty.options.crease_angle_degrees = 180;
  all.push_back(std::move(dirty));
  return all;
}

/// A scan and its mesh, as sampled and relaxed.
class Relaxed : public testing::TestWithParam<Scan> {
 protected:
  Relaxed()
      : domain_(domain::build_domain(GetParam().mesh, GetParam().options, {})),
        laid_out_(remesh::remesh(domain_, {.levels = kLevels}, {}).laid_out),
        sampled_(relax::relax(domain_, laid_out_, kLevels, {.steps = 0}, {})),
        relaxed_(relax::relax(domain_, laid_out_, kLevels, {.steps = 6}, {})) {}

  relax::InputSurface surface() const { return {domain_.mesh, laid_out_.charts.topology}; }
  double diagonal() const { return bounding_box_diagonal(GetParam().mesh.positions); }

  domain::Domain domain_;
  remesh::Parameterisation laid_out_;
  RelaxedMesh sampled_, relaxed_;
};

TEST_P(Relaxed, LiesOnTheInput) {
  const measure::SurfaceIndex input(GetParam().mesh, 1);
  for (const RelaxedMesh* result : {&sampled_, &relaxed_}) {
    const std::vector<Vector3d>& positions = result->mesh.positions;
    ASSERT_EQ(result->points.size(), positions.size());
    for (std::size_t v = 0; v < positions.size(); ++v) {
      ASSERT_LT(std::sqrt(input.closest(positions[v]).distance_squared), 1e-9 * diagonal());
      const relax::SurfacePoint& point = result->points[v];
      ASSERT_EQ(positions[v], surface().position(point));
      ASSERT_GE(point.weights.minCoeff(), 0);
      ASSERT_NEAR(point.weights.sum(), 1, 1e-12);
    }
  }
}

TEST_P(Relaxed, ComesCloseToTheInput) {
  for (const RelaxedMesh* result : {&sampled_, &relaxed_}) {
    const measure::SurfaceDistance distance = measure::compare_surfaces(
        GetParam().mesh, {result->mesh.positions, result->levels.back().triangles},
        {.samples = 20'000, .threads = 1});
    EXPECT_LT(distance.relative_rms(), 1e-2);  // sharp edges of the shapes are untagged here
  }
}

TEST_P(Relaxed, HasTheConnectivityOfTheLevels) {
  const bitstream::BaseTopology& base = laid_out_.base.topology;
  for (const RelaxedMesh* result : {&sampled_, &relaxed_}) {
    EXPECT_EQ(result->mesh.levels, kLevels);
    EXPECT_EQ(result->mesh.base.triangles, base.triangles);
    EXPECT_EQ(result->mesh.base.crease_edges, base.crease_edges);
    EXPECT_EQ(result->mesh.base.corner_vertices, base.corner_vertices);
    ASSERT_EQ(result->levels.size(), kLevels + 1u);
    const SubdividedLevel& finest = result->levels.back();
    EXPECT_EQ(finest.vertex_count, remesh::number_lattices(base, kLevels).vertex_count);
    ASSERT_EQ(result->mesh.positions.size(), finest.vertex_count);
    EXPECT_EQ(finest.triangles.size(), base.triangles.size() << (2 * kLevels));
    EXPECT_NO_THROW(domain::build_topology(finest.vertex_count, finest.triangles));
  }
}

TEST_P(Relaxed, TurnsNoTriangleOver) {
  const relax::ParameterChart chart(laid_out_.base, laid_out_.charts);
  for (const RelaxedMesh* result : {&sampled_, &relaxed_}) {
    EXPECT_EQ(result->report.negative_triangles, 0u);
    for (const Triangle& t : result->levels.back().triangles)
      ASSERT_TRUE(chart.is_positive(chart.place_of(result->points[t[0]]),
                                    chart.place_of(result->points[t[1]]),
                                    chart.place_of(result->points[t[2]])));
  }
  EXPECT_EQ(sampled_.report.rejected_moves, 0u);
}

TEST_P(Relaxed, KeepsCornersWhereTheyAre) {
  for (std::size_t v = 0; v < laid_out_.base.mesh_vertex.size(); ++v) {
    const std::uint32_t vertex = laid_out_.base.mesh_vertex[v];
    if (domain_.kinds[vertex] != domain::VertexKind::corner) continue;
    for (const RelaxedMesh* result : {&sampled_, &relaxed_})
      EXPECT_LT((result->mesh.positions[v] - domain_.mesh.positions[vertex]).norm(),
                1e-12 * diagonal());
  }
}

// The pieces of the finest curves have together the length of the input's curves: each lies on one,
// none is missing, and none goes back over another.
TEST_P(Relaxed, TilesTheFeatureCurves) {
  const InputCurves curves(surface(), domain_.kinds);
  for (const RelaxedMesh* result : {&sampled_, &relaxed_}) {
    const SubdividedLevel& finest = result->levels.back();
    double sum = 0;
    for (std::size_t e = 0; e < finest.edges.size(); ++e) {
      if (!finest.is_feature[e]) continue;
      const auto [a, b] = finest.edges[e];
      const std::optional<double> piece = curves.distance(result->points[a], result->points[b]);
      ASSERT_TRUE(piece) << "an end of " << a << " - " << b << " has left its curve";
      sum += *piece;
    }
    EXPECT_NEAR(sum, curves.length(), 1e-9 * curves.length());
  }
}

/// Mean square of the tangential details of the finest level: from Loop's prediction to the vertex.
double tangential_detail(const RelaxedMesh& result) {
  const SubdividedLevel& coarse = result.levels[kLevels - 1];
  const std::vector<Vector3d>& p = result.mesh.positions;
  std::vector<Vector3d> normals(p.size(), Vector3d::Zero()), predicted(p.size(), Vector3d::Zero());
  for (const Triangle& t : result.levels.back().triangles)
    for (std::uint32_t v : t) normals[v] += (p[t[1]] - p[t[0]]).cross(p[t[2]] - p[t[0]]);
  for (std::size_t f = 0; f < coarse.triangles.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k)
      predicted[coarse.vertex_count + coarse.face_edges[f][k]] +=
          p[coarse.triangles[f][(k + 2) % 3]] / 8;
  double sum = 0;
  for (std::size_t e = 0; e < coarse.edges.size(); ++e) {
    if (coarse.is_feature[e]) continue;
    const std::size_t v = coarse.vertex_count + e;
    const Vector3d detail =
        predicted[v] + 0.375 * (p[coarse.edges[e][0]] + p[coarse.edges[e][1]]) - p[v];
    const Vector3d normal = normals[v].normalized();
    sum += (detail - normal.dot(detail) * normal).squaredNorm();
  }
  return sum / static_cast<double>(coarse.edges.size());
}

TEST_P(Relaxed, HasSmallerTangentialDetails) {
  EXPECT_LT(tangential_detail(relaxed_), 0.3 * tangential_detail(sampled_));
}

TEST_P(Relaxed, IsTheSameForAnyNumberOfThreads) {
  for (const std::size_t threads : {1, 2}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const RelaxedMesh again = relax::relax(domain_, laid_out_, kLevels, {.steps = 6}, {});
    EXPECT_EQ(again.mesh.positions, relaxed_.mesh.positions);
    EXPECT_EQ(again.report.rejected_moves, relaxed_.report.rejected_moves);
    for (std::size_t v = 0; v < again.points.size(); ++v) {
      ASSERT_EQ(again.points[v].face, relaxed_.points[v].face);
      ASSERT_EQ(again.points[v].edge, relaxed_.points[v].edge);
      ASSERT_EQ(again.points[v].weights, relaxed_.points[v].weights);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Scans, Relaxed, testing::ValuesIn(all_scans()),
                         [](const auto& scan) { return scan.param.name; });

// More vertices than one thread takes at once.
TEST(Relax, IsTheSameForAnyNumberOfThreadsOnLargeMeshes) {
  const domain::Domain domain = domain::build_domain(
      add_noise(sphere(5), 0.1, 3),
      {.base_vertices = 40, .crease_angle_degrees = 180, .pinned_vertices = {}}, {});
  const remesh::Parameterisation laid_out = remesh::remesh(domain, {.levels = 4}, {}).laid_out;
  const auto with_threads = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return relax::relax(domain, laid_out, 4, {}, {}).mesh.positions;
  };
  EXPECT_EQ(with_threads(1), with_threads(2));
}

// Creases and boundaries of straight edges are sampled on themselves: nothing is cut off.
TEST(Relax, KeepsCreasesSharp) {
  const TriangleMesh cube = midpoint_subdivide(voxel_surface({{0, 0, 0}}), 4);
  const domain::Domain domain = domain::build_domain(cube, {}, {});
  const remesh::RemeshResult result = remesh::remesh(domain, {}, {});
  for (const int steps : {0, 6}) {
    const RelaxedMesh relaxed =
        relax::relax(domain, result.laid_out, result.report.levels, {.steps = steps}, {});
    EXPECT_EQ(relaxed.mesh.positions.size(), result.report.finest_vertices);
    const measure::SurfaceDistance distance =
        measure::compare_surfaces(cube, {relaxed.mesh.positions, relaxed.levels.back().triangles},
                                  {.samples = 20'000, .threads = 1});
    EXPECT_LT(distance.relative_hausdorff(), 1e-9);
  }
}

TEST(Relax, TakesAnyNumberOfLevels) {
  const domain::Domain domain = domain::build_domain(sphere(3), {}, {});
  const remesh::Parameterisation laid_out = remesh::remesh(domain, {.levels = 0}, {}).laid_out;
  for (const int levels : {0, 1, 2, 3})
    for (const int steps : {0, 1, 6}) {
      const RelaxedMesh relaxed = relax::relax(domain, laid_out, levels, {.steps = steps}, {});
      EXPECT_EQ(relaxed.mesh.levels, levels);
      EXPECT_EQ(relaxed.mesh.positions.size(),
                remesh::count_finest_vertices(laid_out.base.topology, levels));
      EXPECT_EQ(relaxed.levels.back().triangles.size(), laid_out.base.topology.triangles.size()
                                                            << (2 * levels));
      // Coarser triangles do not see their own corners: is_positive wants small ones.
      if (levels >= 2) {
        EXPECT_EQ(relaxed.report.negative_triangles, 0u);
      }
    }
}

TEST(Relax, KeepsASingleTriangle) {
  const domain::Domain domain =
      domain::build_domain({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}, {}, {});
  const remesh::Parameterisation laid_out = remesh::remesh(domain, {.levels = 2}, {}).laid_out;
  for (const int steps : {0, 6}) {
    const RelaxedMesh relaxed = relax::relax(domain, laid_out, 2, {.steps = steps}, {});
    EXPECT_EQ(relaxed.mesh.positions.size(), 15u);
    EXPECT_EQ(relaxed.report.negative_triangles, 0u);
  }
}

}  // namespace
}  // namespace zerotree::test
