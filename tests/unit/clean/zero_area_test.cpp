// Triangles of no area go without tearing the surface.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "clean/clean_mesh.h"
#include "shapes.h"

namespace zerotree::test {
namespace {

using clean::CleanMesh;

double smallest_area(const TriangleMesh& mesh) {
  double smallest = 1e300;
  for (const Triangle& t : mesh.triangles)
    smallest = std::min(smallest, (mesh.positions[t[1]] - mesh.positions[t[0]])
                                      .cross(mesh.positions[t[2]] - mesh.positions[t[0]])
                                      .norm());
  return smallest;
}

// `mesh` with edge a-b of face `face` divided at its middle there only, so that a triangle of no
// area joins the two sides: the faces across the edge stay as they are.
TriangleMesh with_cap(TriangleMesh mesh, std::size_t face, double at = 0.5) {
  const auto [a, b, c] = mesh.triangles[face];
  const auto m = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.push_back((1 - at) * mesh.positions[a] + at * mesh.positions[b]);
  mesh.triangles[face] = {a, m, c};
  mesh.triangles.push_back({m, b, c});
  mesh.triangles.push_back({a, b, m});
  return mesh;
}

TEST(ZeroArea, ACapIsFlippedAndTheSurfaceStaysClosed) {
  const TriangleMesh cube = voxel_surface({{0, 0, 0}});
  const TriangleMesh mesh = with_cap(cube, 0);
  ASSERT_EQ(smallest_area(mesh), 0.0);
  const CleanMesh c = clean::clean_mesh(mesh, {}, {});
  EXPECT_EQ(c.report.flipped_edges, 1u);
  EXPECT_EQ(c.report.boundary_loops, 0u);
  EXPECT_EQ(c.report.nudged_vertices, 0u);
  EXPECT_EQ(c.mesh.triangles.size(), cube.triangles.size() + 2);
  EXPECT_GT(smallest_area(c.mesh), 0.1);
}

TEST(ZeroArea, ChainsOfCapsAreFlipped) {
  TriangleMesh mesh = voxel_surface({{0, 0, 0}});
  for (int i = 0; i < 5; ++i) mesh = with_cap(mesh, 0, 0.25);
  const CleanMesh c = clean::clean_mesh(mesh, {}, {});
  EXPECT_GE(c.report.flipped_edges, 5u);
  EXPECT_EQ(c.report.boundary_loops, 0u);
  EXPECT_EQ(c.report.nudged_vertices + c.report.removed_zero_area_faces, 0u);
  EXPECT_GT(smallest_area(c.mesh), 1e-4);
}

TEST(ZeroArea, AtABoundaryTheFaceIsRemoved) {
  TriangleMesh mesh = grid(1, 1);
  // Half of the boundary edge from vertex 0 to 1, so that the cap hangs on the boundary.
  std::size_t face = 0;
  while (mesh.triangles[face][0] != 0 || mesh.triangles[face][1] != 1) ++face;
  const CleanMesh c = clean::clean_mesh(with_cap(mesh, face), {}, {});
  EXPECT_EQ(c.report.removed_zero_area_faces, 1u);
  EXPECT_EQ(c.report.boundary_loops, 1u);
  EXPECT_EQ(c.mesh.triangles.size(), 3u);
  EXPECT_GT(smallest_area(c.mesh), 0.1);
}

TEST(ZeroArea, WhereNoFlipIsPossibleAVertexMovesALittle) {
  // A tetrahedron pressed onto an edge's line: vertex 3 lies on the edge 0-1 of valence 3.
  const TriangleMesh mesh{{{0, 0, 0}, {2, 0, 0}, {1, 1, 0}, {1, 0, 0}},
                          {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}}};
  const CleanMesh c = clean::clean_mesh(mesh, {}, {});
  EXPECT_EQ(c.report.nudged_vertices, 1u);
  EXPECT_EQ(c.report.boundary_loops, 0u);
  EXPECT_GT(smallest_area(c.mesh), 1e-5);
  EXPECT_LT((c.mesh.positions[3] - mesh.positions[3]).norm(), 1e-3);
}

}  // namespace
}  // namespace zerotree::test
