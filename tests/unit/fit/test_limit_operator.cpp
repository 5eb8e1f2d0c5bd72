// The limit operator of the fit is the one of the runtime.
#include "fit/limit_operator.h"

#include <gtest/gtest.h>

#include <cmath>

#include "fit_shapes.h"
#include "surface/subdivision_hierarchy.h"

namespace zerotree::test {
namespace {

class LimitOperator : public testing::TestWithParam<Shape> {};

// Random points on three axes: rows that differ anywhere differ there.
TEST_P(LimitOperator, IsOpenSubdivs) {
  const bitstream::BaseTopology base = topology_of(GetParam());
  const auto levels = relax::subdivide_base(base, 2);
  const surface::SubdivisionHierarchy hierarchy(base, 2,
                                                surface::WaveletTransform::loop_quadrature_mirror);
  for (const int l : {1, 2}) {
    const relax::SubdividedLevel& level = levels[static_cast<std::size_t>(l)];
    const surface::SharedStencils& expected = hierarchy.level(l).limit;
    ASSERT_EQ(expected.row_count(), level.vertex_count);
    const fit::Points points = random_points(level.vertex_count, 5);
    fit::Points limit;
    fit::LimitOperator(base, level).apply(points, limit);
    for (std::size_t v = 0; v < limit.size(); ++v) {
      const auto indices = expected.row_indices(v);
      Eigen::Vector3d at = Eigen::Vector3d::Zero();
      for (std::size_t i = 0; i < indices.size(); ++i)
        at += static_cast<double>(expected.row_weights(v)[i]) * points[indices[i]];
      ASSERT_LT((limit[v] - at).norm(), 1e-6) << "vertex " << v << " of level " << l;
    }
  }
}

TEST_P(LimitOperator, HasItsTranspose) {
  const bitstream::BaseTopology base = topology_of(GetParam());
  const auto levels = relax::subdivide_base(base, 2);
  const fit::LimitOperator limit(base, levels[2]);
  for (const std::uint32_t seed : {1u, 2u, 3u}) {
    const fit::Points x = random_points(levels[2].vertex_count, seed);
    const fit::Points y = random_points(levels[2].vertex_count, seed + 100);
    fit::Points ax, aty;
    limit.apply(x, ax);
    limit.apply_transposed(y, aty);
    EXPECT_NEAR(dot(ax, y), dot(x, aty), 1e-12 * std::sqrt(dot(ax, ax) * dot(y, y)));
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, LimitOperator, testing::ValuesIn(tagged_shapes()),
                         [](const auto& shape) { return shape.param.name; });

}  // namespace
}  // namespace zerotree::test
