// check_manifold finds each way of not being a manifold; measure_topology counts known surfaces.
#include "clean/manifold_check.h"

#include <gtest/gtest.h>

#include "shapes.h"

namespace zerotree::test {
namespace {

using clean::check_manifold;

void expect_problem(const TriangleMesh& mesh, const std::string& part) {
  EXPECT_NE(check_manifold(mesh).find(part), std::string::npos) << check_manifold(mesh);
}

TEST(ManifoldCheck, PassesEveryClass) {
  for (const Shape& shape : base_shapes()) EXPECT_EQ(check_manifold(shape.mesh), "") << shape.name;
}

TEST(ManifoldCheck, FindsEachDefect) {
  TriangleMesh mesh = icosahedron();
  mesh.positions.push_back({0, 0, 0});
  expect_problem(mesh, "vertex 12 has no face");
  mesh = icosahedron();
  std::swap(mesh.triangles[0][0], mesh.triangles[0][1]);
  expect_problem(mesh, "opposite orientation");
  mesh = icosahedron();
  mesh.triangles.push_back(mesh.triangles[0]);
  expect_problem(mesh, "has 3 faces");
  mesh = icosahedron();
  mesh.triangles[0][0] = 99;
  expect_problem(mesh, "vertex 99, which does not exist");
  mesh.triangles[0] = {1, 1, 2};
  expect_problem(mesh, "names a vertex twice");
  expect_problem({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 1}}},
                 "two faces of the same vertices");
  const std::vector<Eigen::Vector3d> five = {
      {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
  expect_problem({five, {{0, 1, 2}, {0, 3, 4}}}, "vertex 0 has several fans");
  // Two closed fans at one vertex: two tetrahedra that share their first one.
  TriangleMesh pair = disjoint_union(tetrahedron(), tetrahedron(), {5, 0, 0});
  for (Triangle& t : pair.triangles)
    for (std::uint32_t& v : t) v = v == 4 ? 0 : v > 4 ? v - 1 : v;
  pair.positions.pop_back();
  expect_problem(pair, "vertex 0 has several fans");
}

TEST(ManifoldCheck, MeasuresTopology) {
  const auto measured = [](const TriangleMesh& mesh) { return clean::measure_topology(mesh); };
  EXPECT_EQ(measured(sphere(2)).genus, 0);
  EXPECT_EQ(measured(sphere(2)).boundary_loops, 0u);
  EXPECT_EQ(measured(grid(3, 2)).boundary_loops, 1u);
  EXPECT_EQ(measured(grid(3, 2)).boundary_edges, 10u);
  const auto ring = measured(voxel_surface(
      {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {2, 1, 0}, {0, 2, 0}, {1, 2, 0}, {2, 2, 0}}));
  EXPECT_EQ(ring.genus, 1);
  EXPECT_EQ(ring.euler_characteristic, 0);
}

}  // namespace
}  // namespace zerotree::test
