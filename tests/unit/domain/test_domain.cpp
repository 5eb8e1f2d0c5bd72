#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cstdlib>
#include <set>

#include "domain/base_size.h"
#include "domain/domain.h"
#include "mesh/error.h"
#include "shapes.h"

namespace zerotree::domain {
namespace {

// Each class of mesh as a scan: dense, and not flat everywhere.
std::vector<test::Shape> scans() {
  std::vector<test::Shape> scans = test::base_shapes();
  for (test::Shape& scan : scans) {
    scan.mesh = test::midpoint_subdivide(scan.mesh, 3);
    if (scan.crease_edges.empty()) scan.mesh = test::add_bumps(scan.mesh, 0.01, 2.0);
  }
  return scans;
}

DomainOptions options_for(const test::Shape& scan) {
  DomainOptions options;
  options.base_vertices = 20;
  if (scan.crease_edges.empty()) options.crease_angle_degrees = 180;
  return options;
}

// The base mesh with its own vertex numbers.
TriangleTopology base_topology(const Domain& domain) {
  std::vector<std::uint32_t> index(domain.kinds.size(), kNone);
  std::vector<Triangle> faces;
  std::uint32_t count = 0;
  for (std::uint32_t f : domain.base_faces) {
    Triangle& face = faces.emplace_back(domain.topology.faces[f]);
    for (std::uint32_t& v : face) {
      if (index[v] == kNone) index[v] = count++;
      v = index[v];
    }
  }
  return build_topology(count, faces);
}

TEST(Domain, BaseIsASimplicialComplexOfTheSameTopology) {
  for (const test::Shape& scan : scans()) {
    SCOPED_TRACE(scan.name);
    const Domain domain = build_domain(scan.mesh, options_for(scan), {});
    const TriangleTopology base = base_topology(domain);  // throws if it is no manifold
    DomainReport report;
    sum_topology(count_components(base, {}), report);
    EXPECT_EQ(report.components, domain.report.components);
    EXPECT_EQ(report.boundary_loops, domain.report.boundary_loops);
    EXPECT_EQ(report.genus, domain.report.genus);
    std::set<std::array<std::uint32_t, 2>> directed;
    for (const Triangle& t : base.faces)
      for (int k = 0; k < 3; ++k)
        EXPECT_TRUE(directed.insert({t[k], t[kNext[k]]}).second) << "duplicate edge";
    EXPECT_LT(domain.report.base_vertices, scan.mesh.positions.size() / 2);
  }
}

TEST(Domain, CountsTopology) {
  const std::vector<test::Shape> shapes = scans();
  const auto report_of = [&](const std::string& name) {
    const auto scan = std::ranges::find(shapes, name, &test::Shape::name);
    return build_domain(scan->mesh, options_for(*scan), {}).report;
  };
  EXPECT_EQ(report_of("double_torus").genus, 2u);
  EXPECT_EQ(report_of("grid").boundary_loops, 1u);
  EXPECT_EQ(report_of("two_components").components, 2u);
  EXPECT_EQ(report_of("two_components").boundary_loops, 1u);
}

TEST(Domain, UndoingAllCollapsesGivesBackTheMesh) {
  for (const test::Shape& scan : scans()) {
    SCOPED_TRACE(scan.name);
    Domain domain = build_domain(scan.mesh, options_for(scan), {});
    ASSERT_GT(domain.collapses.size(), 10u);
    std::vector<std::uint32_t> fan;
    for (std::size_t i = domain.collapses.size(); i-- > 0;)
      undo_collapse(domain.topology, domain.collapses[i], fan);
    const TriangleTopology whole = build_topology(
        static_cast<std::uint32_t>(domain.mesh.positions.size()), domain.mesh.triangles);
    EXPECT_EQ(domain.topology.faces, whole.faces);
    EXPECT_EQ(domain.topology.adjacent, whole.adjacent);
  }
}

TEST(Domain, KeepsTheCreasesAndCornersOfACube) {
  const TriangleMesh cube = test::midpoint_subdivide(test::voxel_surface({{0, 0, 0}}), 4);
  const Domain domain = build_domain(cube, {}, {});
  EXPECT_EQ(domain.report.crease_edges, 12u * 16);
  EXPECT_EQ(domain.report.corners, 8u);
  std::set<std::uint32_t> kept;
  for (std::uint32_t f : domain.base_faces)
    for (std::uint32_t v : domain.topology.faces[f]) kept.insert(v);
  for (std::uint32_t corner = 0; corner < 8; ++corner) EXPECT_TRUE(kept.contains(corner));
  double length = 0;  // of the base's creases: the chains are straight, so nothing is lost
  for (std::uint32_t f : domain.base_faces)
    for (int k = 0; k < 3; ++k)
      if ((domain.topology.creases[f] >> k) & 1)
        length += (cube.positions[domain.topology.faces[f][k]] -
                   cube.positions[domain.topology.faces[f][kNext[k]]])
                      .norm();
  EXPECT_NEAR(length, 2 * 12.0, 1e-9);
}

TEST(Domain, TakesNoNoiseForCreases) {
  const TriangleMesh noisy = test::add_noise(test::sphere(4), 0.2, 7);
  EXPECT_EQ(build_domain(noisy, {}, {}).report.crease_edges, 0u);
  DomainOptions sharp;
  sharp.crease_angle_degrees = 10;
  EXPECT_GT(build_domain(noisy, sharp, {}).report.crease_edges, 100u);
}

// Sharp all along, but with a corner every 1/80 of the diagonal: a base that kept them all would be
// as large as the mesh.
TEST(Domain, TakesNoThicketOfShortEdgesForCreases) {
  std::vector<std::array<int, 3>> stairs;
  for (int i = 0; i < 60; ++i) {
    stairs.push_back({i, i, 0});
    stairs.push_back({i + 1, i, 0});
  }
  const TriangleMesh mesh = test::midpoint_subdivide(test::voxel_surface(stairs), 1);
  const Domain domain = build_domain(mesh, {}, {});
  EXPECT_EQ(domain.report.crease_edges, 0u);
  DomainOptions all;
  all.crease_angle_degrees = 40;
  EXPECT_GT(build_domain(mesh, all, {}).report.crease_edges, 1000u);
}

TEST(Domain, KeepsPinnedVertices) {
  DomainOptions options;
  options.base_vertices = 12;
  options.pinned_vertices = {100, 200, 300};
  const Domain domain = build_domain(test::sphere(3), options, {});
  for (const CollapseRecord& collapse : domain.collapses)
    EXPECT_FALSE(std::ranges::binary_search(options.pinned_vertices, collapse.removed));
}

TEST(Domain, SplitsEarsOnTheSurface) {
  // Four triangles in a row: both ends are ears.
  const TriangleMesh strip{{{0, 0, 0}, {1, 1, 0}, {2, 0, 0}, {3, 1, 0}, {4, 0, 0}, {5, 1, 0}},
                           {{0, 2, 1}, {1, 2, 3}, {2, 4, 3}, {3, 4, 5}}};
  const Domain domain = build_domain(strip, {}, {});
  EXPECT_GE(domain.report.ear_splits, 2u);
  for (const Eigen::Vector3d& p : domain.mesh.positions) EXPECT_EQ(p.z(), 0);
}

TEST(Domain, KeepsASingleTriangle) {
  const Domain domain = build_domain({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}, {}, {});
  EXPECT_EQ(domain.base_faces.size(), 1u);
  EXPECT_TRUE(domain.collapses.empty());
}

TEST(Domain, RefusesWhatIsNoManifold) {
  const std::vector<Eigen::Vector3d> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
  const std::vector<std::vector<Triangle>> bad{
      {{0, 1, 2}, {0, 1, 3}, {2, 1, 4}},  // unlike orientation
      {{0, 1, 2}, {1, 0, 3}, {1, 0, 4}},  // three faces at an edge
      {{0, 1, 2}, {0, 3, 4}},             // two fans
      {{0, 1, 2}, {0, 2, 3}},             // a vertex without a face
      {{0, 1, 7}}};                       // no such vertex
  for (const std::vector<Triangle>& triangles : bad) {
    try {
      build_domain({points, triangles}, {}, {});
      ADD_FAILURE() << "accepted";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::refused_topology);
    }
  }
}

TEST(Domain, IsTheSameTwice) {
  const TriangleMesh mesh = test::add_noise(test::sphere(4), 0.1, 3);
  const Domain a = build_domain(mesh, {}, {}), b = build_domain(mesh, {}, {});
  EXPECT_EQ(a.base_faces, b.base_faces);
  EXPECT_EQ(a.topology.faces, b.topology.faces);
}

TEST(Domain, IsTheSameForAnyNumberOfThreads) {
  const TriangleMesh mesh = test::add_noise(test::sphere(5), 0.1, 3);
  DomainOptions options;
  options.base_vertices = 40;
  const auto with_threads = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return build_domain(mesh, options, {});
  };
  const Domain one = with_threads(1), two = with_threads(2);
  ASSERT_EQ(one.collapses.size(), two.collapses.size());
  for (std::size_t i = 0; i < one.collapses.size(); ++i) {
    ASSERT_EQ(one.collapses[i].removed, two.collapses[i].removed);
    ASSERT_EQ(one.collapses[i].kept, two.collapses[i].kept);
  }
  EXPECT_EQ(one.topology.faces, two.topology.faces);
}

TEST(Domain, GivesSmoothVerticesTheValencesOfTheWavelets) {
  for (const std::uint32_t base_vertices : {60u, 120u, 300u}) {
    DomainOptions options;
    options.base_vertices = base_vertices;
    options.crease_angle_degrees = 180;
    const TriangleMesh mesh = test::add_noise(test::sphere(5), 0.1, base_vertices);
    const Domain domain = build_domain(mesh, options, {});
    EXPECT_EQ(domain.report.base_vertices, base_vertices);
    EXPECT_EQ(domain.report.low_valences, 0u);
    EXPECT_EQ(domain.report.high_valences, 0u);
    EXPECT_GE(domain.report.min_valence, 5u);
    EXPECT_LE(domain.report.max_valence, 7u);
  }
}

// The collapses of a pass must not depend on each other: undone from the last to the first, every
// mesh on the way is a manifold again.
TEST(Domain, UndoesManyCollapsesThroughManifolds) {
  DomainOptions options;
  options.base_vertices = 12;
  options.crease_angle_degrees = 180;
  const TriangleMesh mesh = test::add_noise(test::sphere(5), 0.3, 5);
  Domain domain = build_domain(mesh, options, {});
  std::vector<std::uint32_t> fan;
  for (std::size_t i = domain.collapses.size(); i-- > 0;) {
    undo_collapse(domain.topology, domain.collapses[i], fan);
    domain.collapses.pop_back();
    if (i % 1024 != 0) continue;
    domain.base_faces.clear();
    std::vector<std::uint8_t> removed(domain.topology.faces.size(), 0);
    for (const CollapseRecord& collapse : domain.collapses)
      removed[collapse.left] = removed[collapse.right] = 1;
    for (std::uint32_t f = 0; f < removed.size(); ++f)
      if (!removed[f]) domain.base_faces.push_back(f);
    EXPECT_EQ(base_topology(domain).face_of_vertex.size(),
              domain.kinds.size() - domain.collapses.size());
  }
  EXPECT_EQ(domain.topology.faces, mesh.triangles);
}

}  // namespace
}  // namespace zerotree::domain
