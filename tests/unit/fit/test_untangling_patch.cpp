// Patches are independent, complete and know how their limit positions move.
#include "fit/untangling_patch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "fit_shapes.h"

namespace zerotree::test {
namespace {

using Eigen::Vector3d;
using fit::Points;

class UntanglingPatch : public testing::TestWithParam<Shape> {
 protected:
  UntanglingPatch()
      : base(topology_of(GetParam())),
        levels(relax::subdivide_base(base, 3)),
        limit(base, levels[3]),
        held(finest().vertex_count, 0) {
    for (std::uint32_t v : base.corner_vertices) held[v] = 1;
  }
  const relax::SubdividedLevel& finest() const { return levels[3]; }
  std::vector<fit::UntanglingPatch> patches(int rings) const {
    const auto last = static_cast<std::uint32_t>(finest().triangles.size() - 1);
    return fit::untangling_patches(finest(), limit, held, {0, last / 2, last}, rings);
  }

  bitstream::BaseTopology base;
  std::vector<relax::SubdividedLevel> levels;
  fit::LimitOperator limit;
  std::vector<std::uint8_t> held;
};

TEST_P(UntanglingPatch, MovesLimitPositionsAsTheOperatorDoes) {
  for (const int rings : {0, 2}) {
    Points points = random_points(finest().vertex_count, 3), before, after;
    limit.apply(points, before);
    Points moved = before;
    const Points moves = random_points(finest().vertex_count, 4);
    for (const fit::UntanglingPatch& patch : patches(rings)) {
      for (std::uint32_t i = 0; i < patch.free_count; ++i) {
        EXPECT_FALSE(held[patch.vertices[i]]);
        points[patch.vertices[i]] += moves[i];
      }
      for (const auto& w : patch.weights) {
        ASSERT_LT(w.vertex, patch.moving_count);
        ASSERT_LT(w.control, patch.free_count);
        moved[patch.vertices[w.vertex]] += w.weight * moves[w.control];
      }
    }
    limit.apply(points, after);
    for (std::size_t v = 0; v < after.size(); ++v)
      EXPECT_LT((after[v] - moved[v]).norm(), 1e-6) << "vertex " << v;
  }
}

TEST_P(UntanglingPatch, HoldsEveryFaceThatMovesOnce) {
  std::map<Triangle, int> faces;
  std::set<std::uint32_t> moving;
  for (const fit::UntanglingPatch& patch : patches(2)) {
    for (std::uint32_t i = 0; i < patch.moving_count; ++i)
      EXPECT_TRUE(moving.insert(patch.vertices[i]).second) << "moves in two patches";
    for (const Triangle& t : patch.faces)
      ++faces[{patch.vertices[t[0]], patch.vertices[t[1]], patch.vertices[t[2]]}];
  }
  for (const Triangle& t : finest().triangles) {
    const bool moves = std::ranges::any_of(t, [&](std::uint32_t v) { return moving.contains(v); });
    EXPECT_EQ(faces[t], moves ? 1 : 0);
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, UntanglingPatch, testing::ValuesIn(tagged_shapes()),
                         [](const auto& shape) { return shape.param.name; });

// All of a sphere's faces within two rings of one, and none beyond.
TEST(UntanglingPatchOfASphere, HasAsManyRingsAsAskedFor) {
  const Shape shape{"sphere", icosahedron(), {}, {}};
  const bitstream::BaseTopology base = topology_of(shape);
  const auto levels = relax::subdivide_base(base, 3);
  const fit::LimitOperator limit(base, levels[3]);
  const std::vector<std::uint8_t> held(levels[3].vertex_count, 0);
  // A face in the middle of a base face: 3 corners, 9 and 15 vertices around, 21 more that move.
  const auto patches = fit::untangling_patches(levels[3], limit, held, {63}, 2);
  ASSERT_EQ(patches.size(), 1u);
  EXPECT_EQ(patches[0].free_count, 27u);
  EXPECT_EQ(patches[0].moving_count, 48u);
}

}  // namespace
}  // namespace zerotree::test
