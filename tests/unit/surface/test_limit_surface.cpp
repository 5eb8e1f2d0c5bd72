// Limit positions and normals.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "surface/edge_frames.h"
#include "surface_shapes.h"

namespace zerotree::test {
namespace {

using surface::Positions;
using surface::SubdivisionHierarchy;

struct Limit {
  Positions positions, normals;
};

Limit limit_of(const SubdivisionHierarchy& hierarchy, const Positions& control, int level) {
  Limit limit{Positions(control.size()), Positions(control.size())};
  surface::limit_surface(hierarchy.level(level), control, {limit.positions.data()},
                         {limit.normals.data()});
  return limit;
}

class LimitSurface : public testing::TestWithParam<Shape> {};

// An even vertex keeps its limit at each level: P and the limit weights fit together.
TEST_P(LimitSurface, DoesNotDependOnTheLevel) {
  const SubdivisionHierarchy hierarchy(topology_of(GetParam()), 3, kQuadratureMirror);
  const Positions base = positions_of(GetParam().mesh);
  const Limit coarse = limit_of(hierarchy, subdivided(hierarchy, base, 1), 1);
  const Limit fine = limit_of(hierarchy, subdivided(hierarchy, base, 3), 3);
  for (std::size_t vertex = 0; vertex < hierarchy.level(1).vertex_count; ++vertex) {
    EXPECT_LT((point_at(coarse.positions, vertex) - point_at(fine.positions, vertex)).norm(), 1e-5);
    // A corner's normal is a mean that moves with the fan.
    EXPECT_GT(point_at(coarse.normals, vertex).dot(point_at(fine.normals, vertex)),
              GetParam().name == "grid" || GetParam().corner_vertices.empty() ? 0.98 : 0.5);
  }
}

TEST_P(LimitSurface, NormalsAreUnitAndOnTheFacesSide) {
  const SubdivisionHierarchy hierarchy(topology_of(GetParam()), 3, kQuadratureMirror);
  const Positions control = subdivided(hierarchy, positions_of(GetParam().mesh), 3);
  const Limit limit = limit_of(hierarchy, control, 3);
  for (const auto& [a, b, c] : hierarchy.level(3).triangles) {
    const Eigen::Vector3d face =
        (point_at(limit.positions, b) - point_at(limit.positions, a))
            .cross(point_at(limit.positions, c) - point_at(limit.positions, a))
            .normalized();
    for (const std::uint32_t corner : {a, b, c}) {
      EXPECT_NEAR(point_at(limit.normals, corner).norm(), 1.0, 1e-6);
      EXPECT_GT(point_at(limit.normals, corner).dot(face), 0.2);
    }
  }
}

// An affine map of the control points is the same map of the surface: across boundaries, creases,
// corners and irregular vertices.
TEST_P(LimitSurface, FollowsAffineMaps) {
  const SubdivisionHierarchy hierarchy(topology_of(GetParam()), 2, kQuadratureMirror);
  Eigen::Matrix3d linear;
  linear << 1.0, 0.5, -0.25, 0.0, 2.0, 0.75, -1.0, 0.25, 1.0;
  const Eigen::Vector3d shift(3.0, -2.0, 1.0);
  TriangleMesh mapped = GetParam().mesh;
  for (auto& p : mapped.positions) p = linear * p + shift;
  const Limit plain =
      limit_of(hierarchy, subdivided(hierarchy, positions_of(GetParam().mesh), 2), 2);
  const Limit image = limit_of(hierarchy, subdivided(hierarchy, positions_of(mapped), 2), 2);
  for (std::size_t vertex = 0; vertex < hierarchy.level(2).vertex_count; ++vertex)
    EXPECT_LT(
        (linear * point_at(plain.positions, vertex) + shift - point_at(image.positions, vertex))
            .norm(),
        1e-5);
}

INSTANTIATE_TEST_SUITE_P(Shapes, LimitSurface, testing::ValuesIn(base_shapes()),
                         [](const auto& shape) { return shape.param.name; });

TEST(LimitSurface, OfAnIcosphereIsNearlyASphere) {
  const TriangleMesh mesh = sphere(3);
  const SubdivisionHierarchy hierarchy(topology_of({"sphere", mesh, {}, {}}), 1, kQuadratureMirror);
  const Limit limit = limit_of(hierarchy, subdivided(hierarchy, positions_of(mesh), 1), 1);
  for (std::size_t vertex = 0; vertex < hierarchy.level(1).vertex_count; ++vertex) {
    const Eigen::Vector3d p = point_at(limit.positions, vertex);
    EXPECT_NEAR(p.norm(), 0.995, 0.004);
    EXPECT_GT(p.normalized().dot(point_at(limit.normals, vertex)), 0.9999);
  }
}

// The cube's edges stay straight and its corners where they are.
TEST(LimitSurface, KeepsCreasesAndCorners) {
  const Shape cube = base_shapes()[2];
  ASSERT_EQ(cube.name, "cube");
  const SubdivisionHierarchy hierarchy(topology_of(cube), 3, kQuadratureMirror);
  const Limit limit = limit_of(hierarchy, subdivided(hierarchy, positions_of(cube.mesh), 3), 3);
  for (std::size_t vertex = 0; vertex < hierarchy.level(3).vertex_count; ++vertex) {
    // A unit cube's face plane: one coordinate at the cube's own extremes.
    const Eigen::Vector3d p = point_at(limit.positions, vertex);
    const Eigen::Vector3d low = cube.mesh.positions[0].cwiseMin(cube.mesh.positions[6]);
    double nearest = 1.0;
    for (int axis = 0; axis < 3; ++axis)
      nearest =
          std::min({nearest, std::abs(p[axis] - low[axis]), std::abs(p[axis] - low[axis] - 1)});
    EXPECT_LT(nearest, 1e-6);
  }
  for (std::size_t corner = 0; corner < 8; ++corner) {
    EXPECT_LT((point_at(limit.positions, corner) - cube.mesh.positions[corner]).norm(), 1e-6);
    const Eigen::Vector3d outward =
        (cube.mesh.positions[corner] - Eigen::Vector3d::Constant(0.5)).normalized();
    EXPECT_GT(point_at(limit.normals, corner).dot(outward), 0.5);
  }
}

TEST(EdgeFrame, IsOrthonormalForAnyTangents) {
  const double huge = 1e300, nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<surface::Vector3> vectors = {
      {0, 0, 0},       {1, 2, 3},   {2, 4, 6},    {-1e-30, 1e-30, 0}, {1e-40, 0, 0},
      {huge, huge, 0}, {nan, 0, 0}, {1e20, 1, 0}, {0, 0, -5},         {1, 2, 3.0000001}};
  for (const auto& along : vectors)
    for (const auto& across : vectors) {
      const surface::EdgeFrame frame = surface::frame_from_tangents(along, across);
      const Eigen::Vector3d n(frame.normal.data()), t1(frame.tangent1.data()),
          t2(frame.tangent2.data());
      EXPECT_NEAR(n.norm(), 1.0, 1e-12);
      EXPECT_NEAR(t1.norm(), 1.0, 1e-12);
      EXPECT_LT((t1.cross(t2) - n).norm(), 1e-12);
    }
}

}  // namespace
}  // namespace zerotree::test
