#include "remesh/remesh.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "measure/surface_distance.h"
#include "measure/surface_index.h"
#include "mesh/error.h"
#include "remesh/lattice_numbering.h"
#include "shapes.h"

namespace zerotree::remesh {
namespace {

struct Scan {
  std::string name;
  TriangleMesh mesh;
  domain::DomainOptions options;
};

std::vector<Scan> scans() {
  std::vector<Scan> scans;
  for (const test::Shape& shape : test::base_shapes()) {
    Scan& scan = scans.emplace_back(Scan{shape.name, test::midpoint_subdivide(shape.mesh, 3), {}});
    scan.options.base_vertices = 20;
    if (!shape.crease_edges.empty()) continue;
    scan.mesh = test::add_noise(test::add_bumps(scan.mesh, 0.01, 2.0), 0.05, 11);
    scan.options.crease_angle_degrees = 180;
  }
  return scans;
}

TriangleMesh finest_mesh(const SemiRegularMesh& mesh) {
  const LatticeNumbering numbering = number_lattices(mesh.base, mesh.levels);
  TriangleMesh finest{mesh.positions, {}};
  const std::uint32_t n = numbering.steps();
  for (std::uint32_t t = 0; t < mesh.base.triangles.size(); ++t)
    for (std::uint32_t j = 0; j < n; ++j)
      for (std::uint32_t i = 0; i + j < n; ++i) {
        finest.triangles.push_back(
            {numbering.at(t, i, j), numbering.at(t, i + 1, j), numbering.at(t, i, j + 1)});
        if (i + j + 1 < n)
          finest.triangles.push_back({numbering.at(t, i + 1, j), numbering.at(t, i + 1, j + 1),
                                      numbering.at(t, i, j + 1)});
      }
  return finest;
}

TEST(Remesh, IsBijectiveOnEveryClass) {
  for (const Scan& scan : scans()) {
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

TEST(Remesh, SamplesLieOnTheSurface) {
  for (const Scan& scan : scans()) {
    SCOPED_TRACE(scan.name);
    const domain::Domain domain = domain::build_domain(scan.mesh, scan.options, {});
    const RemeshResult result = remesh(domain, {}, {});
    ASSERT_EQ(result.mesh.positions.size(), result.report.finest_vertices);
    const measure::SurfaceIndex surface(scan.mesh, 1);
    const double diagonal = bounding_box_diagonal(scan.mesh.positions);
    for (const Eigen::Vector3d& p : result.mesh.positions)
      ASSERT_LT(std::sqrt(surface.closest(p).distance_squared), 1e-9 * diagonal);
    domain::build_topology(result.report.finest_vertices, finest_mesh(result.mesh).triangles);
  }
}

TEST(Remesh, ComesCloseToTheSurface) {
  for (const Scan& scan : scans()) {
    SCOPED_TRACE(scan.name);
    const domain::Domain domain = domain::build_domain(scan.mesh, scan.options, {});
    const RemeshResult result = remesh(domain, {}, {});
    const measure::SurfaceDistance distance = measure::compare_surfaces(
        scan.mesh, finest_mesh(result.mesh), {.samples = 20'000, .threads = 1});
    EXPECT_LT(distance.relative_rms(), 1e-2);  // sharp edges of the shapes are untagged here
  }
}

// Creases and boundaries of straight edges are sampled on themselves: nothing is cut off.
TEST(Remesh, KeepsCreasesSharp) {
  const TriangleMesh cube = test::midpoint_subdivide(test::voxel_surface({{0, 0, 0}}), 4);
  const domain::Domain domain = domain::build_domain(cube, {}, {});
  const RemeshResult result = remesh(domain, {}, {});
  EXPECT_EQ(result.mesh.base.corner_vertices.size(), 8u);
  EXPECT_GE(result.mesh.base.crease_edges.size(), 12u);
  const measure::SurfaceDistance distance =
      measure::compare_surfaces(cube, finest_mesh(result.mesh), {.samples = 20'000, .threads = 1});
  EXPECT_LT(distance.relative_hausdorff(), 1e-9);
}

TEST(Remesh, TakesTheLevelsAskedFor) {
  const domain::Domain domain = domain::build_domain(test::sphere(3), {}, {});
  for (int levels : {0, 1, 3}) {
    const RemeshResult result = remesh(domain, {.levels = levels}, {});
    EXPECT_EQ(result.mesh.levels, levels);
    EXPECT_EQ(finest_mesh(result.mesh).triangles.size(), result.report.base_faces << (2 * levels));
  }
  EXPECT_THROW(remesh(domain, {.levels = 30}, {}), Error);
}

TEST(Remesh, KeepsASingleTriangle) {
  const domain::Domain domain =
      domain::build_domain({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}, {}, {});
  const RemeshResult result = remesh(domain, {.levels = 2}, {});
  EXPECT_EQ(result.mesh.positions.size(), 15u);
}

TEST(Remesh, IsTheSameTwice) {
  const TriangleMesh mesh = test::add_noise(test::sphere(4), 0.1, 3);
  const auto once = [&] { return remesh(domain::build_domain(mesh, {}, {}), {}, {}); };
  const RemeshResult a = once(), b = once();
  EXPECT_EQ(a.mesh.positions, b.mesh.positions);
  EXPECT_EQ(a.mesh.base.triangles, b.mesh.base.triangles);
}

TEST(Remesh, IsTheSameForAnyNumberOfThreads) {
  const TriangleMesh mesh = test::add_noise(test::sphere(5), 0.1, 3);
  domain::DomainOptions options;
  options.base_vertices = 40;
  const domain::Domain domain = domain::build_domain(mesh, options, {});
  const auto with_threads = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return remesh(domain, {}, {}).mesh.positions;
  };
  EXPECT_EQ(with_threads(1), with_threads(2));
}

}  // namespace
}  // namespace zerotree::remesh
