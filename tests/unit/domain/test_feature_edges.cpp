#include "domain/feature_edges.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <set>
#include <utility>

#include "domain/feature_vertices.h"
#include "shapes.h"

namespace zerotree::domain {
namespace {

using Eigen::Vector3d;
using Edges = std::set<std::pair<std::uint32_t, std::uint32_t>>;
// Whether an edge between two points is one that the shape means to be sharp.
using IsSharp = std::function<bool(const Vector3d&, const Vector3d&)>;

TriangleTopology topology_of(const TriangleMesh& mesh) {
  return build_topology(static_cast<std::uint32_t>(mesh.positions.size()), mesh.triangles);
}

Edges tagged_edges(const TriangleMesh& mesh, double angle = 0) {
  TriangleTopology topology = topology_of(mesh);
  tag_crease_edges(mesh, angle, topology);
  Edges edges;
  for (std::uint32_t f = 0; f < topology.faces.size(); ++f)
    for (int k = 0; k < 3; ++k)
      if ((topology.creases[f] >> k) & 1)
        edges.insert(std::minmax({topology.faces[f][k], topology.faces[f][kNext[k]]}));
  return edges;
}

Edges sharp_edges(const TriangleMesh& mesh, const IsSharp& is_sharp) {
  Edges edges;
  for (const Triangle& t : mesh.triangles)
    for (int k = 0; k < 3; ++k)
      if (is_sharp(mesh.positions[t[k]], mesh.positions[t[kNext[k]]]))
        edges.insert(std::minmax({t[k], t[kNext[k]]}));
  return edges;
}

// `mesh` is `smooth` with some noise, vertex by vertex.
void expect_exactly(const TriangleMesh& mesh, const TriangleMesh& smooth, const IsSharp& is_sharp) {
  const Edges expected = sharp_edges(smooth, is_sharp), found = tagged_edges(mesh);
  const bool is_noisy = mesh.positions != smooth.positions;
  std::size_t missing = 0;
  for (const auto& edge : expected) missing += found.contains(edge) ? 0 : 1;
  EXPECT_EQ(missing, 0u) << "of " << expected.size();
  // Noise beside a crease may be as long as a crease that fades away.
  EXPECT_LE(found.size() - (expected.size() - missing), (is_noisy ? expected.size() / 25 : 0))
      << "are too many";
}

// A surface of revolution of straight pieces (radius, height), closed by its poles or its caps.
TriangleMesh turned(const std::vector<std::pair<double, double>>& profile, int segments) {
  TriangleMesh mesh;
  const int rows = static_cast<int>(profile.size());
  for (const auto& [radius, height] : profile)
    for (int i = 0; i < segments; ++i) {
      const double angle = 2 * std::numbers::pi * i / segments;
      mesh.positions.push_back({radius * std::cos(angle), radius * std::sin(angle), height});
    }
  const auto at = [&](int row, int i) {
    return static_cast<std::uint32_t>(row * segments + i % segments);
  };
  for (int row = 0; row + 1 < rows; ++row)
    for (int i = 0; i < segments; ++i) {
      mesh.triangles.push_back({at(row, i), at(row, i + 1), at(row + 1, i)});
      mesh.triangles.push_back({at(row, i + 1), at(row + 1, i + 1), at(row + 1, i)});
    }
  for (const int end : {0, rows - 1}) {
    const auto pole = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.push_back({0, 0, profile[end].second});
    for (int i = 0; i < segments; ++i)
      if (end == 0)
        mesh.triangles.push_back({at(0, i + 1), at(0, i), pole});
      else
        mesh.triangles.push_back({at(end, i), at(end, i + 1), pole});
  }
  return mesh;
}

std::vector<std::pair<double, double>> line(std::pair<double, double> from,
                                            std::pair<double, double> to, int steps) {
  std::vector<std::pair<double, double>> points;
  for (int i = 0; i < steps; ++i) {
    const double t = static_cast<double>(i) / steps;
    points.emplace_back(from.first + t * (to.first - from.first),
                        from.second + t * (to.second - from.second));
  }
  return points;
}

void append(std::vector<std::pair<double, double>>& profile,
            const std::vector<std::pair<double, double>>& more) {
  profile.insert(profile.end(), more.begin(), more.end());
}

TriangleMesh cylinder() {
  std::vector<std::pair<double, double>> profile;
  append(profile, line({0.1, 0}, {1, 0}, 6));
  append(profile, line({1, 0}, {1, 2}, 14));
  append(profile, line({1, 2}, {0.1, 2}, 6));
  profile.emplace_back(0.1, 2.0);
  return turned(profile, 48);
}

TriangleMesh cone() {
  std::vector<std::pair<double, double>> profile;
  append(profile, line({0.1, 0}, {1, 0}, 8));
  append(profile, line({1, 0}, {0.05, 2}, 18));
  profile.emplace_back(0.05, 2.0);
  return turned(profile, 48);
}

// How many of a box's planes x = 0, y = 0, ... a point lies on.
int planes_of(const Vector3d& p, const Vector3d& size) {
  int planes = 0;
  for (int axis = 0; axis < 3; ++axis)
    planes += std::abs(p[axis]) < 1e-9 || std::abs(p[axis] - size[axis]) < 1e-9 ? 1 : 0;
  return planes;
}

IsSharp edge_of_box(const Vector3d& size) {
  return [size](const Vector3d& a, const Vector3d& b) {
    return planes_of((a + b) / 2, size) >= 2 && planes_of(a, size) >= 2 && planes_of(b, size) >= 2;
  };
}

TEST(FeatureEdges, KeepsTheEdgesOfANoisyBox) {
  for (int times : {3, 4, 5})
    for (std::uint32_t seed : {1u, 2u, 3u}) {
      SCOPED_TRACE(std::to_string(times) + " " + std::to_string(seed));
      const TriangleMesh box =
          test::midpoint_subdivide(test::voxel_surface({{0, 0, 0}, {1, 0, 0}}), times);
      expect_exactly(test::add_noise(box, 0.1, seed), box, edge_of_box({2, 1, 1}));
    }
}

TEST(FeatureEdges, KeepsTheEdgesOfAnLShape) {
  const TriangleMesh shape = test::midpoint_subdivide(
      test::voxel_surface({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}, {0, 2, 0}}), 3);
  const auto on_profile = [](const Vector3d& p) {  // an edge of the L in x and y
    const auto is = [](double a, double b) { return std::abs(a - b) < 1e-9; };
    return (is(p.x(), 0) || is(p.x(), 3) || (is(p.x(), 1) && p.y() >= 1 - 1e-9)) +
           (is(p.y(), 0) || is(p.y(), 3) || (is(p.y(), 1) && p.x() >= 1 - 1e-9));
  };
  const IsSharp is_sharp = [&](const Vector3d& a, const Vector3d& b) {
    const Vector3d middle = (a + b) / 2;
    const bool on_cap = std::abs(middle.z()) < 1e-9 || std::abs(middle.z() - 1) < 1e-9;
    return on_profile(middle) + (on_cap ? 1 : 0) >= 2;
  };
  expect_exactly(shape, shape, is_sharp);
  for (std::uint32_t seed : {4u, 5u})
    expect_exactly(test::add_noise(shape, 0.1, seed), shape, is_sharp);
}

TEST(FeatureEdges, KeepsTheRimsOfACylinderAndACone) {
  const auto is_rim = [](const Vector3d& a, const Vector3d& b) {
    const auto on_rim = [](const Vector3d& p) {
      return std::abs(std::hypot(p.x(), p.y()) - 1) < 1e-9;
    };
    const bool flat = std::abs(a.z() - b.z()) < 1e-9;
    return on_rim(a) && on_rim(b) && flat && (a.z() < 1e-9 || a.z() > 2 - 1e-9);
  };
  const TriangleMesh can = cylinder(), hat = cone();
  expect_exactly(can, can, is_rim);
  for (std::uint32_t seed : {6u, 7u}) expect_exactly(test::add_noise(can, 0.05, seed), can, is_rim);
  // The cone's top is cut off: a small ring.
  const auto is_rim_of_cone = [&](const Vector3d& a, const Vector3d& b) {
    return is_rim(a, b) || (std::hypot(a.x(), a.y()) > 0.01 && std::hypot(b.x(), b.y()) > 0.01 &&
                            a.z() == 2 && b.z() == 2);
  };
  expect_exactly(hat, hat, is_rim_of_cone);
}

// Edges of 45 degrees beside each other: each is a crease of its own.
TEST(FeatureEdges, KeepsBothEdgesOfABevel) {
  std::vector<std::pair<double, double>> profile;
  append(profile, line({0.1, 0}, {1, 0}, 6));
  append(profile, line({1, 0}, {1.2, 0.2}, 2));
  append(profile, line({1.2, 0.2}, {1.2, 2}, 12));
  append(profile, line({1.2, 2}, {0.1, 2}, 6));
  profile.emplace_back(0.1, 2.0);
  const TriangleMesh shape = turned(profile, 48);
  EXPECT_EQ(tagged_edges(shape).size(), 3u * 48);
}

// A part with a hole much smaller than itself: the hole's rims are creases all the same.
TEST(FeatureEdges, KeepsASmallRimOnALargePart) {
  std::vector<std::pair<double, double>> profile;
  append(profile, line({0.1, 0}, {5, 0}, 30));
  append(profile, line({5, 0}, {5, 2}, 10));
  append(profile, line({5, 2}, {0.2, 2}, 30));
  append(profile, line({0.2, 2}, {0.2, 1}, 10));
  append(profile, line({0.2, 1}, {0.05, 1}, 2));
  profile.emplace_back(0.05, 1.0);
  const TriangleMesh shape = turned(profile, 40);
  EXPECT_EQ(tagged_edges(shape).size(), 4u * 40);
}

TEST(FeatureEdges, TakesNoNoiseOfScansForCreases) {
  for (std::uint32_t seed : {1u, 2u, 3u}) {
    EXPECT_TRUE(tagged_edges(test::add_noise(test::sphere(4), 0.2, seed)).empty());
    EXPECT_TRUE(tagged_edges(test::add_noise(test::add_bumps(test::sphere(5), 0.03, 3), 0.3, seed))
                    .empty());
  }
}

// A sheet with a fold that flattens out: the crease ends, and its end is smooth in the stencils but
// stays where it is.
TEST(FeatureEdges, EndsACreaseWhereTheFoldFlattensOut) {
  TriangleMesh sheet = test::grid(20, 40);
  for (Vector3d& p : sheet.positions)
    p.z() = 1.2 * std::abs(p.x() - 10) * std::max(0.0, 1 - p.y() / 36);
  TriangleTopology topology = topology_of(sheet);
  tag_crease_edges(sheet, 0, topology);
  const std::vector<VertexKind> kinds = classify_vertices(sheet, topology);
  int ends = 0, on_fold = 0;
  for (std::uint32_t v = 0; v < kinds.size(); ++v) {
    const Vector3d& p = sheet.positions[v];
    if (p.x() < 0.5 || p.x() > 19.5 || p.y() < 0.5 || p.y() > 39.5) continue;
    if (kinds[v] == VertexKind::smooth) continue;
    EXPECT_EQ(p.x(), 10);
    ++on_fold;
    ends += kinds[v] == VertexKind::corner ? 1 : 0;
  }
  EXPECT_EQ(ends, 1);
  EXPECT_GT(on_fold, 25);
  EXPECT_LT(on_fold, 36);
}

}  // namespace
}  // namespace zerotree::domain
