// Lattices against OpenSubdiv's mesh-wide stencils: the same vertices, positions and normals.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <random>
#include <tuple>

#include "irregular_shapes.h"
#include "lattice/level_schedule.h"
#include "surface_shapes.h"

namespace zerotree::test {
namespace {

using surface::LatticeMesh;
using surface::LevelSchedule;
using surface::Positions;
using surface::SubdivisionHierarchy;

/// Random details in three of ten cells, of a length of at most `first` steps at level 0 and a
/// quarter of that at each next: about as those of a smooth surface.
bitstream::CoefficientSet random_coefficients(const SubdivisionHierarchy& hierarchy, int levels,
                                              double first) {
  std::mt19937 random(17);
  std::uniform_real_distribution<double> chance(0.0, 1.0), signed_share(-1.0, 1.0);
  bitstream::CoefficientSet set;
  set.base_edge_count = hierarchy.base_edges().size();
  set.levels = levels;
  for (auto& channel : set.channels)
    for (int level = 0; level < levels; ++level) {
      // Two is the value of a step, which is the finer the coarser the level.
      const double most = 2.0 * first * std::pow(0.25, level) *
                          static_cast<double>(surface::basis_norm(levels - 1 - level));
      for (std::size_t cell = 0; cell < set.base_edge_count << (2 * level); ++cell)
        channel.push_back(
            chance(random) < 0.3 ? static_cast<std::int32_t>(most * signed_share(random)) : 0);
    }
  return set;
}

/// The same as the lattices take them.
std::vector<surface::LevelDetails> level_details(const bitstream::CoefficientSet& set,
                                                 const surface::Dequantisation& dequantisation) {
  std::vector<surface::LevelDetails> details(static_cast<std::size_t>(set.levels));
  for (int level = 0; level < set.levels; ++level)
    for (std::size_t c = 0; c < set.channels.size(); ++c) {
      auto& of_level = details[static_cast<std::size_t>(level)];
      of_level.channels[c].wide =
          set.channels[c].data() + bitstream::level_offset(set.base_edge_count, level);
      of_level.units[c] =
          detail_unit(dequantisation, set.levels, level, static_cast<bitstream::Channel>(c));
    }
  return details;
}

struct Limits {
  explicit Limits(std::size_t vertices) : positions(3 * vertices), normals(3 * vertices) {}
  surface::LimitOutput output() { return {{positions.data()}, {normals.data()}}; }
  std::vector<float> positions, normals;
};

double diagonal_of(const Positions& points) {
  Eigen::AlignedBox3d box;
  for (std::size_t v = 0; 3 * v < points.size(); ++v) box.extend(point_at(points, v));
  return box.diagonal().norm();
}

class Lattices : public testing::TestWithParam<std::tuple<Shape, int>> {
 protected:
  Lattices()
      : shape_(std::get<0>(GetParam())),
        levels_(std::get<1>(GetParam())),
        base_(topology_of(shape_)),
        hierarchy_(base_, levels_, kLocal),
        mesh_(base_, bitstream::number_base_edges(base_).edges, std::pmr::get_default_resource()),
        positions_(positions_of(shape_.mesh)) {}

  Limits expected(const bitstream::CoefficientSet& set, const surface::Dequantisation& d) {
    Limits limits(hierarchy_.level(levels_).vertex_count);
    const auto points = reconstruct(hierarchy_, positions_, set, d, levels_);
    limit_surface(hierarchy_.level(levels_), points, limits.output().positions,
                  limits.output().normals);
    return limits;
  }

  surface::SurfaceSource source(std::span<const surface::LevelDetails> details) const {
    return {positions_, details, surface::mean_face_area(base_, positions_)};
  }

  void expect_same(const Limits& found, const Limits& expected) {
    const double size = diagonal_of(positions_);
    ASSERT_EQ(found.positions.size(), expected.positions.size());
    double position = 0.0, normal = 0.0, normals = 0.0;
    for (std::size_t v = 0; 3 * v < found.positions.size(); ++v) {
      position = std::max(position,
                          (point_at(found.positions, v) - point_at(expected.positions, v)).norm());
      const double turn = (point_at(found.normals, v) - point_at(expected.normals, v)).norm();
      normal = std::max(normal, turn);
      normals += turn;
    }
    EXPECT_LE(position, 1e-6 * size);
    // The last digit of a position turns the normal of a small or flat triangle by much more.
    EXPECT_LE(normal, 1e-3);
    EXPECT_LE(normals, 1e-5 * static_cast<double>(found.positions.size() / 3));
  }

  Shape shape_;
  int levels_;
  bitstream::BaseTopology base_;
  SubdivisionHierarchy hierarchy_;
  LatticeMesh mesh_;
  Positions positions_;
};

TEST_P(Lattices, HaveOpenSubdivsTriangles) {
  mesh_.deepen(levels_);
  const auto& triangles = hierarchy_.level(levels_).triangles;
  const std::size_t inside = std::size_t{1} << (2 * levels_);
  ASSERT_EQ(triangles.size(), inside * mesh_.triangle_count());
  std::vector<std::uint32_t> indices(3 * inside);
  for (std::size_t triangle = 0; triangle < mesh_.triangle_count(); ++triangle) {
    mesh_.write_triangles(levels_, triangle, indices.data());
    ASSERT_TRUE(std::equal(indices.begin(), indices.end(), triangles[inside * triangle].data()))
        << "base triangle " << triangle;
  }
}

TEST_P(Lattices, HaveTheSmoothSurface) {
  LevelSchedule schedule(mesh_, {}, std::pmr::get_default_resource());
  Limits found(hierarchy_.level(levels_).vertex_count);
  ASSERT_TRUE(schedule.write_limits(levels_, source({}), found.output(), {}));
  expect_same(found, expected({}, {}));
}

TEST_P(Lattices, HaveTheDetailedSurface) {
  const auto set = random_coefficients(hierarchy_, levels_, 500.0);
  const surface::Dequantisation steps{static_cast<float>(1e-4 * diagonal_of(positions_)), 4.0f};
  const auto details = level_details(set, steps);
  LevelSchedule schedule(mesh_, {}, std::pmr::get_default_resource());
  Limits found(hierarchy_.level(levels_).vertex_count);
  ASSERT_TRUE(schedule.write_limits(levels_, source(details), found.output(), {}));
  expect_same(found, expected(set, steps));
}

constexpr auto kNameOfShapeAndLevels = [](const auto& test) {
  return std::get<0>(test.param).name + "_" + std::to_string(std::get<1>(test.param));
};
INSTANTIATE_TEST_SUITE_P(Shapes, Lattices,
                         testing::Combine(testing::ValuesIn(base_shapes()),
                                          testing::Values(0, 1, 2, 4)),
                         kNameOfShapeAndLevels);
INSTANTIATE_TEST_SUITE_P(IrregularShapes, Lattices,
                         testing::Combine(testing::ValuesIn(irregular_shapes()),
                                          testing::Values(0, 1, 3)),
                         kNameOfShapeAndLevels);

}  // namespace
}  // namespace zerotree::test
