// Numbering along the curve keeps the surface and brings neighbours together.
#include "clean/spatial_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>

#include "clean/manifold_check.h"
#include "shapes.h"

namespace zerotree::test {
namespace {

using Corners = std::array<std::array<double, 3>, 3>;

// The faces as places in space, sorted.
std::vector<Corners> surface_of(const TriangleMesh& mesh) {
  std::vector<Corners> faces;
  for (const Triangle& t : mesh.triangles) {
    Corners& corners = faces.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      const Eigen::Vector3d& p = mesh.positions[t[k]];
      corners[k] = {p.x(), p.y(), p.z()};
    }
  }
  std::ranges::sort(faces);
  return faces;
}

TriangleMesh shuffled(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> place(mesh.positions.size());
  for (std::uint32_t v = 0; v < place.size(); ++v) place[v] = v;
  std::mt19937 random(1);
  std::ranges::shuffle(place, random);
  TriangleMesh result = mesh;
  for (std::size_t v = 0; v < place.size(); ++v) result.positions[place[v]] = mesh.positions[v];
  for (Triangle& t : result.triangles)
    for (std::uint32_t& v : t) v = place[v];
  std::ranges::shuffle(result.triangles, random);
  return result;
}

// Mean difference between the numbers of the ends of an edge.
double mean_leap(const TriangleMesh& mesh) {
  double sum = 0;
  for (const Triangle& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k)
      sum += std::abs(static_cast<double>(t[k]) - static_cast<double>(t[(k + 1) % 3]));
  return sum / (3 * static_cast<double>(mesh.triangles.size()));
}

TEST(SpatialOrder, KeepsTheSurface) {
  for (const Shape& shape : base_shapes()) {
    SCOPED_TRACE(shape.name);
    TriangleMesh sorted = shape.mesh;
    clean::sort_spatially(sorted);
    EXPECT_EQ(clean::check_manifold(sorted), "");
    EXPECT_EQ(surface_of(sorted), surface_of(shape.mesh));
  }
}

TEST(SpatialOrder, BringsNeighboursTogether) {
  TriangleMesh mesh = shuffled(sphere(5));
  const double before = mean_leap(mesh);
  clean::sort_spatially(mesh);
  EXPECT_LT(mean_leap(mesh), before / 10);
  // Faces follow their vertices.
  EXPECT_TRUE(std::ranges::is_sorted(mesh.triangles, {},
                                     [](const Triangle& t) { return std::ranges::min(t); }));
}

TEST(SpatialOrder, DoesNotDependOnTheOrderBefore) {
  TriangleMesh one = sphere(3), other = shuffled(one);
  clean::sort_spatially(one);
  clean::sort_spatially(other);
  EXPECT_EQ(one.positions, other.positions);
}

TEST(SpatialOrder, TakesEmptyAndFlatMeshes) {
  TriangleMesh empty;
  clean::sort_spatially(empty);
  EXPECT_TRUE(empty.positions.empty());
  TriangleMesh point{{{1, 1, 1}, {1, 1, 1}}, {}};
  clean::sort_spatially(point);
  EXPECT_EQ(point.positions.size(), 2u);
}

}  // namespace
}  // namespace zerotree::test
