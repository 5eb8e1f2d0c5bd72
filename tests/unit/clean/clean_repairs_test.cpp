// Each repair on a mesh that needs exactly that one, with exact counts.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "clean/clean_mesh.h"
#include "clean/manifold_check.h"
#include "mesh/error.h"
#include "shapes.h"

namespace zerotree::test {
namespace {

using clean::CleanMesh;

CleanMesh cleaned(const TriangleMesh& mesh) {
  CleanMesh result = clean::clean_mesh(mesh, {}, {});
  EXPECT_EQ(clean::check_manifold(result.mesh), "");
  EXPECT_EQ(result.face_component.size(), result.mesh.triangles.size());
  EXPECT_EQ(result.source_vertex.size(), result.mesh.positions.size());
  return result;
}

// Expects that the repairs are just `expected`, as "count what" in order.
void expect_repairs(const CleanMesh& mesh, const std::vector<std::string>& expected) {
  std::vector<std::string> actual;
  for (const auto& [what, count] : clean::list_repairs(mesh.report))
    actual.push_back(std::to_string(count) + " " + what);
  EXPECT_EQ(actual, expected);
}

// Every triangle with three vertices of its own.
TriangleMesh soup_of(const TriangleMesh& mesh) {
  TriangleMesh soup;
  for (const Triangle& t : mesh.triangles) {
    const auto first = static_cast<std::uint32_t>(soup.positions.size());
    for (std::uint32_t v : t) soup.positions.push_back(mesh.positions[v]);
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  return soup;
}

double volume(const TriangleMesh& mesh) {
  double sum = 0;
  for (const Triangle& t : mesh.triangles)
    sum += mesh.positions[t[0]].dot(mesh.positions[t[1]].cross(mesh.positions[t[2]])) / 6;
  return sum;
}

void turn(Triangle& t) {
  std::swap(t[1], t[2]);
}

TEST(Clean, LeavesACleanMeshOfEachClassAsItIs) {
  for (const Shape& shape : base_shapes()) {
    SCOPED_TRACE(shape.name);
    const CleanMesh c = cleaned(shape.mesh);
    expect_repairs(c, {});
    EXPECT_EQ(c.mesh.triangles, shape.mesh.triangles);
    EXPECT_EQ(c.mesh.positions, shape.mesh.positions);
    for (std::uint32_t v = 0; v < c.source_vertex.size(); ++v) EXPECT_EQ(c.source_vertex[v], v);
    EXPECT_EQ(c.component_count, shape.name == "two_components" ? 2u : 1u);
    EXPECT_EQ(c.report.genus, shape.name == "double_torus" ? 2 : 0);
  }
}

TEST(Clean, WeldsEqualPositionsAndDropsUnreferencedVertices) {
  TriangleMesh mesh = soup_of(icosahedron());
  mesh.positions.push_back({9, 9, 9});
  mesh.positions.push_back(mesh.positions[0]);  // equal to another, but named by no face
  const CleanMesh c = cleaned(mesh);
  expect_repairs(
      c, {"48 vertices welded to another at the same place", "2 unreferenced vertices dropped"});
  EXPECT_EQ(c.mesh.positions.size(), 12u);
  EXPECT_EQ(c.report.boundary_loops, 0u);
  for (std::size_t v = 0; v < 12; ++v)
    EXPECT_EQ(c.mesh.positions[v], mesh.positions[c.source_vertex[v]]);
}

TEST(Clean, WeldsZeroOfEitherSign) {
  TriangleMesh mesh{{{0.0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-0.0, 0, -0.0}, {0, -1, 0}},
                    {{0, 1, 2}, {3, 4, 1}}};
  expect_repairs(cleaned(mesh), {"1 vertices welded to another at the same place"});
}

TEST(Clean, DropsDegenerateAndDuplicateFaces) {
  TriangleMesh mesh = icosahedron();
  const Triangle t = mesh.triangles[3];
  mesh.triangles.push_back({t[0], t[0], t[1]});
  mesh.triangles.push_back({t[1], t[2], t[0]});  // the same, rotated
  mesh.triangles.push_back({t[1], t[0], t[2]});  // the same, turned
  const CleanMesh c = cleaned(mesh);
  expect_repairs(c, {"1 faces with a repeated vertex dropped", "2 duplicate faces dropped"});
  EXPECT_EQ(c.mesh.triangles, icosahedron().triangles);
}

TEST(Clean, KeepsOneSideOfATwoSidedSheet) {
  TriangleMesh mesh = grid(3, 3);
  for (const Triangle& t : grid(3, 3).triangles) mesh.triangles.push_back({t[0], t[2], t[1]});
  const CleanMesh c = cleaned(mesh);
  expect_repairs(c, {"18 duplicate faces dropped"});
  EXPECT_EQ(c.mesh.triangles, grid(3, 3).triangles);
}

TEST(Clean, DropsAFoldThatWeldingPressedFlat) {
  // What is left of a slit in edge 5-6 whose two sides were welded: a triangle and its reverse.
  TriangleMesh mesh = grid(3, 3);
  mesh.positions.push_back({1.5, 1.5, 1});
  mesh.triangles.push_back({5, 6, 16});
  mesh.triangles.push_back({6, 5, 16});
  const CleanMesh c = cleaned(mesh);
  expect_repairs(
      c, {"1 duplicate faces dropped", "1 flat folds dropped", "1 unreferenced vertices dropped"});
  EXPECT_EQ(c.mesh.triangles, grid(3, 3).triangles);
}

TEST(Clean, TurnsTheMinority) {
  TriangleMesh mesh = grid(4, 4);
  for (std::size_t f : {1u, 7u, 20u}) turn(mesh.triangles[f]);
  const CleanMesh c = cleaned(mesh);
  expect_repairs(c, {"3 faces turned to agree with their neighbours"});
  EXPECT_EQ(c.mesh.triangles, grid(4, 4).triangles);
}

TEST(Clean, GivesAnInconsistentClosedSurfaceAPositiveVolume) {
  TriangleMesh mesh = icosahedron();
  for (std::size_t f = 0; f < 15; ++f) turn(mesh.triangles[f]);  // the majority is wrong
  const CleanMesh c = cleaned(mesh);
  expect_repairs(c, {"5 faces turned to agree with their neighbours",
                     "1 closed components turned inside out"});
  EXPECT_GT(volume(c.mesh), 0);
}

TEST(Clean, TurnsAMeshThatIsInsideOutButKeepsCavities) {
  TriangleMesh inside_out = sphere(1);
  for (Triangle& t : inside_out.triangles) turn(t);
  expect_repairs(cleaned(inside_out), {"1 closed components turned inside out"});

  TriangleMesh cavity = sphere(1);
  for (Eigen::Vector3d& p : cavity.positions) p *= 0.5;
  for (Triangle& t : cavity.triangles) turn(t);
  const CleanMesh hollow = cleaned(disjoint_union(sphere(1), cavity, {0, 0, 0}));
  expect_repairs(hollow, {});
  EXPECT_NEAR(volume(hollow.mesh), 0.875 * volume(sphere(1)), 1e-12);
}

TEST(Clean, SplitsAVertexWithTwoFans) {
  const CleanMesh c =
      cleaned({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}}, {{0, 1, 2}, {0, 3, 4}}});
  expect_repairs(c, {"1 vertices added where several fans met"});
  EXPECT_EQ(c.component_count, 2u);
  EXPECT_EQ(c.mesh.positions[0], c.mesh.positions[5]);
  EXPECT_EQ(c.source_vertex[5], 0u);
}

TEST(Clean, SeparatesCubesThatTouchAlongAnEdge) {
  const CleanMesh c = cleaned(voxel_surface({{0, 0, 0}, {1, 1, 0}}));
  expect_repairs(
      c, {"1 edges of more than two faces separated", "2 vertices added where several fans met"});
  EXPECT_EQ(c.component_count, 2u);
  EXPECT_EQ(c.report.boundary_loops, 0u);
  EXPECT_NEAR(volume(c.mesh), 2.0, 1e-12);
}

TEST(Clean, CutsAFinFromTheFlatSheetItStandsOn) {
  TriangleMesh mesh = grid(2, 1);  // vertices 1 and 4 are the middle edge
  mesh.positions.push_back({1, 0.5, 1});
  mesh.triangles.push_back({1, 4, 6});
  const CleanMesh c = cleaned(mesh);
  expect_repairs(
      c, {"1 edges of more than two faces separated", "2 vertices added where several fans met"});
  EXPECT_EQ(c.component_count, 2u);
  EXPECT_EQ(c.face_component, (std::vector<std::uint32_t>{0, 0, 0, 0, 1}));
}

TEST(Clean, DividesAnEdgeWhereOneSurfaceTouchesItself) {
  // A ring of cubes whose ends touch along an edge only: both ends of the edge belong to one fan.
  const CleanMesh c = cleaned(voxel_surface(
      {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {2, 2, 0}, {1, 2, 0}, {1, 1, 1}, {1, 2, 1}}));
  EXPECT_EQ(c.report.boundary_loops, 0u);
  EXPECT_NEAR(volume(c.mesh), 8.0, 1e-12);
}

TEST(Clean, LabelsComponentsByTheirFirstFace) {
  const CleanMesh c = cleaned(disjoint_union(grid(1, 1), tetrahedron(), {5, 0, 0}));
  EXPECT_EQ(c.face_component, (std::vector<std::uint32_t>{0, 0, 1, 1, 1, 1}));
  EXPECT_EQ(c.report.boundary_edges, 4u);
  EXPECT_EQ(c.report.boundary_loops, 1u);
  EXPECT_EQ(c.report.euler_characteristic, 3);
}

TEST(Clean, IsTheSameTwice) {
  TriangleMesh mesh = add_noise(soup_of(voxel_surface({{0, 0, 0}, {1, 1, 0}, {1, 2, 1}})), 0.0, 1);
  const CleanMesh a = cleaned(mesh), b = cleaned(mesh);
  EXPECT_EQ(a.mesh.triangles, b.mesh.triangles);
  EXPECT_EQ(a.source_vertex, b.source_vertex);
}

// A band of `faces` triangles with half a twist.
TriangleMesh moebius_strip(std::uint32_t segments) {
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < segments; ++i) {
    const double angle = 2 * M_PI * i / segments, twist = angle / 2;
    for (double side : {-0.3, 0.3}) {
      const double r = 1 + side * std::cos(twist);
      mesh.positions.push_back({r * std::cos(angle), r * std::sin(angle), side * std::sin(twist)});
    }
  }
  for (std::uint32_t i = 0; i < segments; ++i) {
    std::uint32_t a = 2 * i, b = a + 1, c = (2 * i + 2) % (2 * segments), d = c + 1;
    if (i + 1 == segments) std::swap(c, d);
    mesh.triangles.push_back({a, c, b});
    mesh.triangles.push_back({b, c, d});
  }
  return mesh;
}

void expect_refused(const TriangleMesh& mesh, ExitCode code, const std::string& part) {
  try {
    clean::clean_mesh(mesh, {}, {});
    ADD_FAILURE() << "was cleaned";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), code);
    EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
  }
}

TEST(Clean, RefusesWhatCannotBeASurface) {
  expect_refused(moebius_strip(12), ExitCode::refused_topology, "one-sided");
  expect_refused({}, ExitCode::refused_topology, "no surface is left");
  expect_refused({{{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}, {{0, 1, 2}}}, ExitCode::refused_topology,
                 "no surface is left");
  expect_refused({{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}, {{0, 1, 2}}}, ExitCode::refused_topology,
                 "no surface is left");
  TriangleMesh broken = tetrahedron();
  broken.triangles[2][1] = 4;
  expect_refused(broken, ExitCode::unreadable_input, "face 2 names vertex 4");
  broken = tetrahedron();
  broken.positions[3].y() = std::nan("");
  expect_refused(broken, ExitCode::unreadable_input, "vertex 3");
}

}  // namespace
}  // namespace zerotree::test
