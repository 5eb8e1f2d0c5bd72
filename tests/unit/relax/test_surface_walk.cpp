// Walking straight on over faces and along feature curves.
#include "relax/surface_walk.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "shapes.h"

namespace zerotree::test {
namespace {

using domain::VertexKind;
using Eigen::Vector3d;
using relax::InputSurface;
using relax::SurfacePoint;

/// A mesh that points walk on.
struct Ground {
  explicit Ground(TriangleMesh m)
      : mesh(std::move(m)),
        topology(domain::build_topology(static_cast<std::uint32_t>(mesh.positions.size()),
                                        mesh.triangles)) {}
  InputSurface surface() const { return {mesh, topology}; }

  TriangleMesh mesh;
  domain::TriangleTopology topology;
};

/// Makes edges a crease whose ends both fulfil `is_on`.
template <class Predicate>
void crease(Ground& ground, const Predicate& is_on) {
  for (std::size_t f = 0; f < ground.topology.faces.size(); ++f)
    for (int k = 0; k < 3; ++k) {
      const Triangle& t = ground.topology.faces[f];
      if (is_on(ground.mesh.positions[t[k]]) && is_on(ground.mesh.positions[t[domain::kNext[k]]]))
        ground.topology.creases[f] |= static_cast<std::uint8_t>(1 << k);
    }
}

/// The point of a mesh over the plane whose plane coordinates are `x`, `y`; `flat` is the mesh
/// before it was bent.
SurfacePoint point_at(const TriangleMesh& flat, double x, double y) {
  const Vector3d p(x, y, 0);
  for (std::uint32_t f = 0; f < flat.triangles.size(); ++f) {
    const Triangle& t = flat.triangles[f];
    const auto area = [&](const Vector3d& a, const Vector3d& b, const Vector3d& c) {
      return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
    };
    const Vector3d &a = flat.positions[t[0]], &b = flat.positions[t[1]], &c = flat.positions[t[2]];
    const Vector3d weights = Vector3d(area(p, b, c), area(a, p, c), area(a, b, p)) / area(a, b, c);
    if (weights.minCoeff() >= 0) return {f, -1, weights};
  }
  ADD_FAILURE() << "no face at " << x << ", " << y;
  return {};
}

void expect_on_face(const SurfacePoint& point) {
  EXPECT_GE(point.weights.minCoeff(), 0);
  EXPECT_NEAR(point.weights.sum(), 1, 1e-12);
}

/// Rolls up the plane without stretching it: along x it goes round a prism of side 1, so that it is
/// folded at each whole x.
Vector3d rolled(const Vector3d& p, double fold) {
  Vector3d at(0, p.y(), 0);
  double left = p.x();
  for (int side = 0; left > 0; ++side, left -= 1)
    at += std::min(left, 1.0) * Vector3d(std::cos(side * fold), 0, std::sin(side * fold));
  return at;
}

TEST(WalkOnSurface, IsStraightOnAPlane) {
  const Ground ground(add_noise(grid(7, 5), 0.0, 1));
  const InputSurface surface = ground.surface();
  std::mt19937 random(4);
  const auto next = [&](double end) {
    return 0.01 + (end - 0.02) * static_cast<double>(random()) * 0x1p-32;
  };
  for (int i = 0; i < 200; ++i) {
    const Vector3d from(next(7), next(5), 0), to(next(7), next(5), 0);
    const SurfacePoint end =
        relax::walk_on_surface(surface, point_at(ground.mesh, from.x(), from.y()), to - from);
    EXPECT_LT((surface.position(end) - to).norm(), 1e-12);
    expect_on_face(end);
  }
}

// The unfolded way is straight: that fixes its length and its direction.
TEST(WalkOnSurface, KeepsItsLengthRoundBends) {
  const TriangleMesh flat = grid(7, 5);
  for (const double fold : {0.3, std::numbers::pi / 2, -1.0, 2.5}) {
    TriangleMesh bent = flat;
    for (Vector3d& p : bent.positions) p = rolled(p, fold);
    const Ground ground(bent);
    const InputSurface surface = ground.surface();
    std::mt19937 random(9);
    const auto next = [&](double end) {
      return 0.01 + (end - 0.02) * static_cast<double>(random()) * 0x1p-32;
    };
    for (int i = 0; i < 100; ++i) {
      const Vector3d from(next(7), next(5), 0), to(next(7), next(5), 0);
      const SurfacePoint start = point_at(flat, from.x(), from.y());
      const double side = std::floor(from.x()) * fold;
      const Vector3d along(std::cos(side), 0, std::sin(side));
      const Vector3d step = (to - from).x() * along + (to - from).y() * Vector3d::UnitY();
      const SurfacePoint end = relax::walk_on_surface(surface, start, step);
      EXPECT_LT((surface.position(end) - rolled(to, fold)).norm(), 1e-9);
      expect_on_face(end);
    }
  }
}

TEST(WalkOnSurface, TakesThePartInItsFacesPlane) {
  const Ground ground(grid(3, 3));
  const SurfacePoint end =
      relax::walk_on_surface(ground.surface(), point_at(ground.mesh, 0.5, 0.25), {1, 1, 17});
  EXPECT_LT((ground.surface().position(end) - Vector3d(1.5, 1.25, 0)).norm(), 1e-12);
}

TEST(WalkOnSurface, StopsAtCreasesAndBoundaries) {
  Ground ground(grid(6, 4));
  crease(ground, [](const Vector3d& p) { return p.x() == 3; });
  const InputSurface surface = ground.surface();
  const auto end_of = [&](double x, double y, const Vector3d& step) {
    const SurfacePoint end = relax::walk_on_surface(surface, point_at(ground.mesh, x, y), step);
    expect_on_face(end);
    return surface.position(end);
  };
  EXPECT_LT((end_of(1.25, 1.5, {7, 0.7, 0}) - Vector3d(3, 1.675, 0)).norm(), 1e-12);
  EXPECT_LT((end_of(4.75, 1.5, {-7, 0.7, 0}) - Vector3d(3, 1.675, 0)).norm(), 1e-12);
  EXPECT_LT((end_of(4.75, 1.5, {5, 0.5, 0}) - Vector3d(6, 1.625, 0)).norm(), 1e-12);
  EXPECT_LT((end_of(1.25, 1.5, {0.25, -30, 0}) - Vector3d(1.2625, 0, 0)).norm(), 1e-12);
  // From a crease it goes on to either side, but not over it.
  const Vector3d on_crease = end_of(1.25, 1.5, {7, 0.7, 0});
  EXPECT_LT((end_of(on_crease.x(), on_crease.y(), {-1, 0, 0}) - Vector3d(2, 1.675, 0)).norm(),
            1e-12);
}

TEST(WalkOnSurface, CrossesFacesWithoutArea) {
  // The middle face is a line from (1, 0) to (1, 2).
  const Ground ground({{{0, 1, 0}, {1, 0, 0}, {1, 2, 0}, {1, 1, 0}, {2, 1, 0}},
                       {{0, 1, 2}, {1, 3, 2}, {1, 4, 3}, {3, 4, 2}}});
  const InputSurface surface = ground.surface();
  for (const Vector3d& step : {Vector3d(1, 0.1, 0), Vector3d(0.5, 0, 0), Vector3d(0.7, -0.1, 0)}) {
    const SurfacePoint end = relax::walk_on_surface(surface, {0, -1, {0.4, 0.3, 0.3}}, step);
    expect_on_face(end);
    EXPECT_LT((surface.position(end) - Vector3d(0.6, 1, 0) - step).norm(), 1e-12);
  }
  const SurfacePoint inside{1, -1, {0.2, 0.4, 0.4}};
  EXPECT_EQ(relax::walk_on_surface(surface, inside, {1, 0, 0}).weights, inside.weights);
}

/// A disc whose boundary is a regular polygon of `sides` sides of length 1.
Ground disc(int sides) {
  const double radius = 0.5 / std::sin(std::numbers::pi / sides);
  TriangleMesh mesh{{{0, 0, 0}}, {}};
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * std::numbers::pi * i / sides;
    mesh.positions.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0);
    mesh.triangles.push_back(
        {0, static_cast<std::uint32_t>(1 + i), static_cast<std::uint32_t>(1 + (i + 1) % sides)});
  }
  return Ground(std::move(mesh));
}

TEST(WalkAlongFeature, KeepsItsLengthRoundACurve) {
  constexpr int sides = 12;
  const Ground ground = disc(sides);
  const InputSurface surface = ground.surface();
  const std::vector<VertexKind> kinds(ground.mesh.positions.size(), VertexKind::chain);
  // Edge 1 of face i is side i of the boundary.
  const SurfacePoint start{2, 1, {0, 0.75, 0.25}};
  const Vector3d along =
      (ground.mesh.positions[4] - ground.mesh.positions[3]).normalized() + 3 * Vector3d::UnitZ();
  for (const double length : {0.0, 0.5, 0.75, 1.0, 6.5, -0.2, -0.25, -2.1, -30.0}) {
    const SurfacePoint end = relax::walk_along_feature(surface, kinds, start, length * along);
    double s = std::fmod(2.25 + length, sides);
    if (s < 0) s += sides;
    const auto side = static_cast<std::uint32_t>(s);
    const Vector3d a = ground.mesh.positions[1 + side];
    const Vector3d b = ground.mesh.positions[1 + (side + 1) % sides];
    EXPECT_LT((surface.position(end) - (a + (s - side) * (b - a))).norm(), 1e-9) << length;
    EXPECT_EQ(end.edge, 1);
    expect_on_face(end);
  }
}

TEST(WalkAlongFeature, StopsBeforeCorners) {
  const Ground ground = disc(8);
  const InputSurface surface = ground.surface();
  std::vector<VertexKind> kinds(ground.mesh.positions.size(), VertexKind::chain);
  kinds[3] = kinds[6] = VertexKind::corner;
  const SurfacePoint start{3, 1, {0, 0.5, 0.5}};  // between vertices 4 and 5
  const Vector3d along = ground.mesh.positions[5] - ground.mesh.positions[4];
  for (const double length : {1.5, 2.0, 100.0}) {
    // As far as the last edge, inside of it; the same side again when it goes on.
    SurfacePoint forward = start, back = start;
    for (int i = 0; i < 3; ++i) {
      const Vector3d onward =
          i == 0 ? along : (ground.mesh.positions[6] - ground.mesh.positions[5]).eval();
      forward = relax::walk_along_feature(surface, kinds, forward, length * onward);
      EXPECT_EQ(forward.face, 4u);
      EXPECT_EQ(forward.edge, 1);
      EXPECT_GT(forward.weights[1], 0);
      EXPECT_GE(forward.weights[2], 0.5);
      const Vector3d backward =
          i == 0 ? along : (ground.mesh.positions[4] - ground.mesh.positions[3]).eval();
      back = relax::walk_along_feature(surface, kinds, back, -length * backward);
      EXPECT_EQ(back.face, 2u);
      EXPECT_EQ(back.edge, 1);
      EXPECT_GT(back.weights[2], 0);
      EXPECT_GE(back.weights[1], 0.5);
    }
  }
}

// A crease belongs to the faces on both sides, which see it run in opposite directions.
TEST(WalkAlongFeature, FollowsCreasesFromEitherSide) {
  Ground ground(grid(4, 6));
  crease(ground, [](const Vector3d& p) { return p.x() == 2; });
  const InputSurface surface = ground.surface();
  const std::vector<VertexKind> kinds(ground.mesh.positions.size(), VertexKind::chain);
  for (const double x : {1.75, 2.25})
    for (const double step : {2.25, -2.25}) {
      SurfacePoint start =
          relax::walk_on_surface(surface, point_at(ground.mesh, x, 3.5), {2 * (2 - x), 0, 0});
      ASSERT_TRUE(relax::snap_to_feature(surface, start));
      const SurfacePoint end = relax::walk_along_feature(surface, kinds, start, {5, step, 0});
      EXPECT_LT((surface.position(end) - Vector3d(2, 3.5 + step, 0)).norm(), 1e-12);
    }
}

TEST(SnapToFeature, FindsEdgesAndVerticesOfCurves) {
  const Ground ground(grid(3, 3));
  const InputSurface surface = ground.surface();
  SurfacePoint inside = point_at(ground.mesh, 1.3, 1.6);
  EXPECT_FALSE(relax::snap_to_feature(surface, inside));
  SurfacePoint at_inner_vertex = point_at(ground.mesh, 1, 1);
  EXPECT_FALSE(relax::snap_to_feature(surface, at_inner_vertex));
  for (std::uint32_t f = 0; f < ground.mesh.triangles.size(); ++f)
    for (int k = 0; k < 3; ++k) {
      // Every corner of every face, also of those that touch the boundary by a vertex only.
      SurfacePoint at{f, -1, Vector3d::Unit(k)};
      const Vector3d p = surface.position(at);
      const bool is_outer = p.x() == 0 || p.y() == 0 || p.x() == 3 || p.y() == 3;
      ASSERT_EQ(relax::snap_to_feature(surface, at), is_outer) << p.transpose();
      EXPECT_EQ(surface.position(at), p);
      if (is_outer) {
        EXPECT_TRUE(domain::is_feature(ground.topology, at.face, at.edge));
      }
    }
  SurfacePoint near{0, -1, {0.5, 0.5 - 1e-10, 1e-10}};  // edge 0 of face 0 lies on y = 0
  ASSERT_TRUE(relax::snap_to_feature(surface, near));
  EXPECT_EQ(near.edge, 0);
  EXPECT_EQ(surface.position(near).y(), 0);
}

}  // namespace
}  // namespace zerotree::test
