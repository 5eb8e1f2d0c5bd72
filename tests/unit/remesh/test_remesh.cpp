#include "remesh/remesh.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "clean/spatial_order.h"
#include "mesh/error.h"
#include "remesh/lattice_numbering.h"
#include "scans.h"
#include "shapes.h"

namespace zerotree::remesh {
namespace {

TEST(Remesh, IsBijectiveOnEveryClass) {
  for (const test::Scan& scan : test::scans()) {
    SCOPED_TRACE(scan.name);
    const domain::Domain domain = domain::build_domain(scan.mesh, scan.options, {});
    const Parameterisation laid_out = parameterise(domain, {});
    if (laid_out.stuck > 0) continue;  // remesh() builds such a base again
    const BijectivityReport report = check_bijectivity(laid_out.charts, laid_out.base);
    EXPECT_EQ(report.flipped_faces, 0u);
    EXPECT_LT(report.worst_coverage, 1e-9);
    EXPECT_EQ(laid_out.charts.topology.faces, domain.mesh.triangles);
  }
}

// The checker itself: a vertex moved out of its ring must not go unseen.
TEST(Remesh, BijectivityCheckSeesAFlip) {
  domain::DomainOptions options;
  options.base_vertices = 12;
  const domain::Domain domain = domain::build_domain(test::sphere(3), options, {});
  Parameterisation laid_out = parameterise(domain, {});
  ASSERT_EQ(laid_out.stuck, 0u);
  laid_out.charts.vertices[domain.collapses[0].removed].point += LatticePoint(0.4, 0.3);
  EXPECT_GT(check_bijectivity(laid_out.charts, laid_out.base).flipped_faces, 0u);
}

// The base has the edges and corners of a cube.
TEST(Remesh, KeepsCreasesAndCorners) {
  const TriangleMesh cube = test::midpoint_subdivide(test::voxel_surface({{0, 0, 0}}), 4);
  const domain::Domain domain = domain::build_domain(cube, {}, {});
  const RemeshResult result = remesh(domain, {}, {});
  EXPECT_EQ(result.laid_out.base.topology.corner_vertices.size(), 8u);
  EXPECT_GE(result.laid_out.base.topology.crease_edges.size(), 12u);
  EXPECT_EQ(result.report.base_corners, 8u);
  EXPECT_EQ(result.report.base_crease_edges, result.laid_out.base.topology.crease_edges.size());
}

TEST(Remesh, TakesTheLevelsAskedFor) {
  const domain::Domain domain = domain::build_domain(test::sphere(3), {}, {});
  for (int levels : {0, 1, 3}) {
    const RemeshResult result = remesh(domain, {.levels = levels}, {});
    EXPECT_EQ(result.report.levels, levels);
    EXPECT_EQ(result.report.base_faces, result.laid_out.base.topology.triangles.size());
    EXPECT_EQ(result.report.finest_vertices,
              count_finest_vertices(result.laid_out.base.topology, levels));
  }
  EXPECT_THROW(remesh(domain, {.levels = 30}, {}), Error);
}

TEST(Remesh, KeepsASingleTriangle) {
  const domain::Domain domain =
      domain::build_domain({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}, {}, {});
  const RemeshResult result = remesh(domain, {.levels = 2}, {});
  EXPECT_EQ(result.laid_out.base.topology.triangles.size(), 1u);
  EXPECT_EQ(result.report.finest_vertices, 15u);
}

// Bit for bit: where every vertex and face lies, and on what.
void expect_same(const RemeshResult& a, const RemeshResult& b) {
  EXPECT_EQ(a.laid_out.base.topology.triangles, b.laid_out.base.topology.triangles);
  EXPECT_EQ(a.laid_out.base.mesh_vertex, b.laid_out.base.mesh_vertex);
  EXPECT_EQ(a.laid_out.charts.transitions, b.laid_out.charts.transitions);
  EXPECT_EQ(a.report.levels, b.report.levels);
  ASSERT_EQ(a.laid_out.charts.vertices.size(), b.laid_out.charts.vertices.size());
  for (std::size_t v = 0; v < a.laid_out.charts.vertices.size(); ++v) {
    ASSERT_EQ(a.laid_out.charts.vertices[v].point, b.laid_out.charts.vertices[v].point);
    ASSERT_EQ(a.laid_out.charts.vertices[v].triangle, b.laid_out.charts.vertices[v].triangle);
  }
}

TEST(Remesh, IsTheSameTwice) {
  const TriangleMesh mesh = test::add_noise(test::sphere(4), 0.1, 3);
  const auto once = [&] { return remesh(domain::build_domain(mesh, {}, {}), {}, {}); };
  expect_same(once(), once());
}

TEST(Remesh, IsTheSameForAnyNumberOfThreads) {
  const TriangleMesh mesh = test::add_noise(test::sphere(5), 0.1, 3);
  domain::DomainOptions options;
  options.base_vertices = 40;
  const domain::Domain domain = domain::build_domain(mesh, options, {});
  const auto with_threads = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return remesh(domain, {}, {});
  };
  expect_same(with_threads(1), with_threads(2));
}

// Large and in such an order that collapses are undone part by part.
TEST(Remesh, IsTheSameForAnyNumberOfThreadsOfALargeMesh) {
  TriangleMesh mesh = test::add_noise(test::sphere(6), 0.1, 3);
  clean::sort_spatially(mesh);
  domain::DomainOptions options;
  options.base_vertices = 40;
  const domain::Domain domain = domain::build_domain(mesh, options, {});
  const auto with_threads = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return remesh(domain, {}, {});
  };
  const RemeshResult one = with_threads(1);
  expect_same(one, with_threads(3));
  EXPECT_EQ(one.laid_out.charts.topology.faces, mesh.triangles);
}

TEST(Remesh, RefinesACoarseVersion) {
  domain::DomainOptions options;
  options.base_vertices = 20;
  const domain::Domain fine =
      domain::build_domain(test::add_noise(test::sphere(5), 0.1, 3), options, {});
  const domain::CoarseDomain coarse = domain::extract_coarse(fine, fine.collapses.size() - 100);
  const Parameterisation laid_out = refine(fine, coarse, parameterise(coarse.domain, {}), {});
  ASSERT_EQ(laid_out.stuck, 0u);
  EXPECT_EQ(laid_out.charts.topology.faces, fine.mesh.triangles);
  const BijectivityReport report = check_bijectivity(laid_out.charts, laid_out.base);
  EXPECT_EQ(report.flipped_faces, 0u);
  EXPECT_LT(report.worst_coverage, 1e-9);
}

}  // namespace
}  // namespace zerotree::remesh
