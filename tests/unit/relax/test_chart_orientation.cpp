// Orientation of triangles on the flat base surface, also across edges and around cones.
#include "relax/chart_orientation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "remesh/remesh.h"
#include "shapes.h"

namespace zerotree::test {
namespace {

using relax::ChartPlace;
using relax::ParameterChart;
using remesh::LatticePoint;

/// A mesh that is its own base mesh.
struct Flat {
  explicit Flat(const TriangleMesh& mesh)
      : domain(domain::build_domain(
            mesh,
            {.base_vertices = static_cast<std::uint32_t>(mesh.positions.size()),
             .crease_angle_degrees = 180,
             .pinned_vertices = {}},
            {})),
        base(remesh::build_base_domain(domain)),
        charts(remesh::build_base_charts(domain, base)),
        chart(base, charts) {}

  domain::Domain domain;
  remesh::BaseDomain base;
  remesh::ConeCharts charts;
  ParameterChart chart;
};

/// Random numbers that are the same with each library.
class Random {
 public:
  explicit Random(std::uint32_t seed) : engine_(seed) {}
  double in(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_()) * 0x1p-32;
  }
  std::uint32_t below(std::size_t count) {
    return static_cast<std::uint32_t>(in(0, static_cast<double>(count)));
  }
  LatticePoint in_triangle() {
    const double x = in(0, 1), y = in(0, 1);
    return x + y < 1 ? LatticePoint(x, y) : LatticePoint(1 - x, 1 - y);
  }

 private:
  std::mt19937 engine_;
};

double plane_area(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  return (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
}

/// All six orders: the even ones are positive if `positive`, the odd ones if not.
void expect_orientation(const ParameterChart& chart, const ChartPlace& a, const ChartPlace& b,
                        const ChartPlace& c, bool positive) {
  EXPECT_EQ(chart.is_positive(a, b, c), positive);
  EXPECT_EQ(chart.is_positive(b, c, a), positive);
  EXPECT_EQ(chart.is_positive(c, a, b), positive);
  EXPECT_EQ(chart.is_positive(a, c, b), !positive);
  EXPECT_EQ(chart.is_positive(c, b, a), !positive);
  EXPECT_EQ(chart.is_positive(b, a, c), !positive);
}

/// Each class of base mesh.
std::vector<TriangleMesh> bases() {
  std::vector<TriangleMesh> bases;
  for (const Shape& shape : base_shapes()) bases.push_back(shape.mesh);
  return bases;
}

TEST(ChartOrientation, InsideOneTriangle) {
  Random random(1);
  for (const TriangleMesh& mesh : bases()) {
    const Flat flat(mesh);
    for (int i = 0; i < 100; ++i) {
      const std::uint32_t t = random.below(flat.base.topology.triangles.size());
      const LatticePoint a = random.in_triangle(), b = random.in_triangle(),
                         c = random.in_triangle();
      const double area = remesh::lattice_area(a, b, c);
      if (std::abs(area) > 1e-9) expect_orientation(flat.chart, {t, a}, {t, b}, {t, c}, area > 0);
    }
    EXPECT_FALSE(flat.chart.is_positive({0, {0, 0}}, {0, {0.5, 0}}, {0, {1, 0}}));
  }
}

TEST(ChartOrientation, AcrossAnEdge) {
  Random random(2);
  for (const TriangleMesh& mesh : bases()) {
    const Flat flat(mesh);
    std::vector<int> valences(mesh.positions.size(), 0);
    for (const Triangle& t : flat.base.topology.triangles)
      for (std::uint32_t v : t) ++valences[v];
    for (std::uint32_t t = 0; t < flat.base.topology.triangles.size(); ++t)
      for (int k = 0; k < 3; ++k) {
        const std::uint32_t next = flat.base.adjacent[t][k];
        if (next == domain::kNone) continue;
        const remesh::LatticeIsometry& transition = flat.base.transitions[t][k];
        const Triangle& corners = flat.base.topology.triangles[t];
        // Round a vertex of valence 3 there is a shorter way between points far from the edge.
        const bool is_narrow =
            valences[corners[k]] == 3 || valences[corners[domain::kNext[k]]] == 3;
        const LatticePoint middle = remesh::apply(remesh::corner_chart(k), {0.5, 0});
        const LatticePoint middle_there = remesh::apply(transition, middle);
        for (int i = 0; i < 10; ++i) {
          const double size = is_narrow ? 0.4 : 1;
          const LatticePoint a = middle + size * (random.in_triangle() - middle);
          const LatticePoint b = middle_there + size * (random.in_triangle() - middle_there);
          const LatticePoint c = middle_there + size * (random.in_triangle() - middle_there);
          const double area = remesh::lattice_area(remesh::apply(transition, a), b, c);
          if (std::abs(area) > 1e-9)
            expect_orientation(flat.chart, {t, a}, {next, b}, {next, c}, area > 0);
        }
      }
  }
}

/// The fan of the vertex `mesh_vertex`, counter-clockwise: triangles and the corner of each.
std::vector<std::pair<std::uint32_t, int>> fan_of(const Flat& flat, std::uint32_t mesh_vertex) {
  const auto& base = flat.base;
  std::uint32_t vertex = 0;
  while (base.mesh_vertex[vertex] != mesh_vertex) ++vertex;
  std::uint32_t first = 0;
  while (std::ranges::count(base.topology.triangles[first], vertex) == 0) ++first;
  std::vector<std::pair<std::uint32_t, int>> fan;
  std::uint32_t t = first;
  do {
    const int corner = domain::corner_of(base.topology.triangles[t], vertex);
    fan.emplace_back(t, corner);
    t = base.adjacent[t][domain::kPrev[corner]];
  } while (t != first);
  return fan;
}

/// A point in the fan of a cone by its polar coordinates, the angle in units of 60 degrees.
struct Polar {
  double turns, radius;

  Eigen::Vector2d unfolded() const {
    const double angle = turns * std::numbers::pi / 3;
    return radius * Eigen::Vector2d(std::cos(angle), std::sin(angle));
  }
  ChartPlace in(const std::vector<std::pair<std::uint32_t, int>>& fan) const {
    const double round = static_cast<double>(fan.size());
    const double at = turns - round * std::floor(turns / round);
    const auto [triangle, corner] = fan[static_cast<std::size_t>(at) % fan.size()];
    const double angle = (at - std::floor(at)) * std::numbers::pi / 3;
    const LatticePoint p =
        remesh::to_lattice(radius * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
    return {triangle, remesh::apply(remesh::corner_chart(corner), p)};
  }
};

class ConeOrientation : public testing::TestWithParam<int> {};

// Three points within half the cone's angle and half a turn see each other as if unfolded.
TEST_P(ConeOrientation, BesideTheCone) {
  const int valence = GetParam();
  const Flat flat(bipyramid(valence));
  const auto fan = fan_of(flat, static_cast<std::uint32_t>(valence));
  ASSERT_EQ(fan.size(), static_cast<std::size_t>(valence));
  Random random(3);
  const double window = std::min(3.0, 0.5 * valence) - 0.1;
  for (int i = 0; i < 2000; ++i) {
    const double start = random.in(0, valence);
    const auto next = [&] { return Polar{start + random.in(0, window), random.in(0.05, 0.86)}; };
    const Polar a = next(), b = next(), c = next();
    const double area = plane_area(a.unfolded(), b.unfolded(), c.unfolded());
    if (std::abs(area) > 1e-9)
      expect_orientation(flat.chart, a.in(fan), b.in(fan), c.in(fan), area > 0);
  }
}

// The base vertex itself has a place in any triangle of its fan.
TEST_P(ConeOrientation, AtTheCone) {
  const int valence = GetParam();
  const Flat flat(bipyramid(valence));
  const auto fan = fan_of(flat, static_cast<std::uint32_t>(valence));
  Random random(4);
  const double window = std::min(3.0, 0.5 * valence) - 0.1;
  for (int i = 0; i < 500; ++i) {
    const double start = random.in(0, valence);
    const double turns = random.in(0.01, window);
    const Polar b{start, random.in(0.05, 0.86)}, c{start + turns, random.in(0.05, 0.86)};
    const auto [triangle, corner] = fan[random.below(fan.size())];
    const ChartPlace cone{triangle, remesh::apply(remesh::corner_chart(corner), {0, 0})};
    expect_orientation(flat.chart, cone, b.in(fan), c.in(fan), true);
  }
}

TEST_P(ConeOrientation, AroundTheCone) {
  const int valence = GetParam();
  const Flat flat(bipyramid(valence));
  const auto fan = fan_of(flat, static_cast<std::uint32_t>(valence));
  Random random(5);
  for (int i = 0; i < 500; ++i) {
    const double start = random.in(0, valence), third = valence / 3.0;
    const auto next = [&](int k) {
      return Polar{start + third * (k + random.in(-0.05, 0.05)), random.in(0.05, 0.86)};
    };
    expect_orientation(flat.chart, next(0).in(fan), next(1).in(fan), next(2).in(fan), true);
  }
}

INSTANTIATE_TEST_SUITE_P(Valences, ConeOrientation, testing::Range(3, 9));

TEST(ChartOrientation, FarApartIsNotPositive) {
  const Flat flat(grid(8, 8));
  const auto place = [&](double x, double y) {
    const std::uint32_t square = static_cast<std::uint32_t>(y) * 8 + static_cast<std::uint32_t>(x);
    return flat.chart.place_of({2 * square, -1, {0.3, 0.4, 0.3}});
  };
  EXPECT_FALSE(flat.chart.is_positive(place(0, 0), place(7, 0), place(0, 7)));
  EXPECT_FALSE(flat.chart.is_positive(place(0, 0), place(0, 7), place(7, 0)));
}

// On a mesh of many faces per base triangle: halfway in the chart of the base triangle.
TEST(ChartMidpoint, LiesHalfway) {
  const domain::Domain domain = domain::build_domain(
      add_noise(sphere(3), 0.05, 3),
      {.base_vertices = 14, .crease_angle_degrees = 180, .pinned_vertices = {}}, {});
  const remesh::Parameterisation laid_out = remesh::parameterise(domain, {});
  ASSERT_EQ(laid_out.stuck, 0u);
  const ParameterChart chart(laid_out.base, laid_out.charts);
  Random random(6);
  int inside = 0, across = 0;
  for (int i = 0; i < 20000 && (inside < 300 || across < 300); ++i) {
    const auto next = [&] {
      const LatticePoint p = random.in_triangle();
      return relax::SurfacePoint{
          random.below(domain.mesh.triangles.size()), -1, {1 - p.x() - p.y(), p.x(), p.y()}};
    };
    const relax::SurfacePoint a = next(), b = next();
    const ChartPlace from = chart.place_of(a), to = chart.place_of(b);
    ASSERT_TRUE(remesh::is_inside(from.point + LatticePoint(1e-12, 1e-12)));
    LatticePoint halfway = (from.point + to.point) / 2;
    if (from.triangle != to.triangle) {
      const auto& adjacent = laid_out.base.adjacent[from.triangle];
      const auto k = std::ranges::find(adjacent, to.triangle) - adjacent.begin();
      if (k == 3) continue;
      const remesh::LatticeIsometry back =
          remesh::inverse(laid_out.base.transitions[from.triangle][static_cast<std::size_t>(k)]);
      halfway = (from.point + remesh::apply(back, to.point)) / 2;
    }
    ++(from.triangle == to.triangle ? inside : across);
    const auto middle = chart.midpoint(a, b);
    ASSERT_TRUE(middle);
    const remesh::BasePlace expected =
        remesh::walk(laid_out.base, from.triangle, from.point, halfway);
    const ChartPlace found = chart.place_of(*middle);
    if (found.triangle != expected.triangle) continue;  // on the edge between the two
    EXPECT_LT((found.point - expected.point).norm(), 1e-9);
  }
  EXPECT_GE(inside, 300);
  EXPECT_GE(across, 300);
}

}  // namespace
}  // namespace zerotree::test
