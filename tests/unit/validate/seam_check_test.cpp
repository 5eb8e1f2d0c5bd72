#include "validate/seam_check.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "progressive/progressive_surface.h"
#include "shapes.h"

namespace zerotree::validate {
namespace {

using bitstream::BaseEdge;

bitstream::BaseTopology topology_of(const TriangleMesh& mesh) {
  bitstream::BaseTopology base;
  base.vertex_count = static_cast<std::uint32_t>(mesh.positions.size());
  base.triangles = mesh.triangles;
  return base;
}

std::vector<float> flat(const TriangleMesh& mesh) {
  std::vector<float> values;
  for (const Eigen::Vector3d& p : mesh.positions)
    for (int k = 0; k < 3; ++k) values.push_back(static_cast<float>(p[k]));
  return values;
}

// Two grids of 2 x 2 squares that meet in the plane x = 2, each with vertices of its own there.
TriangleMesh two_grids() {
  return test::disjoint_union(test::grid(2, 2), test::grid(2, 2), {2, 0, 0});
}

std::vector<BaseSeam> seams_of(const TriangleMesh& mesh) {
  return find_base_seams(bitstream::number_base_edges(topology_of(mesh)).edges, flat(mesh));
}

TEST(BaseSeams, AreBoundaryEdgesThatLieOnEachOther) {
  const TriangleMesh mesh = two_grids();
  const std::vector<BaseSeam> seams = seams_of(mesh);
  ASSERT_EQ(seams.size(), 2u);
  for (const BaseSeam& seam : seams) {
    EXPECT_LT(seam.faces[0], 8u);
    EXPECT_GE(seam.faces[1], 8u);
    for (std::size_t end = 0; end < 2; ++end) {
      EXPECT_NE(seam.vertices[0][end], seam.vertices[1][end]);
      EXPECT_EQ(mesh.positions[seam.vertices[0][end]], mesh.positions[seam.vertices[1][end]]);
      EXPECT_EQ(mesh.positions[seam.vertices[0][end]].x(), 2);
    }
  }
}

TEST(BaseSeams, AreNoneWhereNothingLiesOnAnother) {
  for (const test::Shape& shape : test::base_shapes())
    EXPECT_TRUE(seams_of(shape.mesh).empty()) << shape.name;
}

TEST(BaseSeams, TakeBothZerosForOnePlace) {
  TriangleMesh mesh = two_grids();
  for (std::size_t v = 0; v < mesh.positions.size() / 2; ++v) mesh.positions[v].z() = -0.0;
  EXPECT_EQ(seams_of(mesh).size(), 2u);
}

TEST(BaseSeams, AreLeftOutWhereTheyCouldNotBeJoined) {
  // A third sheet at the same edges.
  const TriangleMesh three =
      test::disjoint_union(two_grids(), test::grid(2, 2), Eigen::Vector3d(2, 0, 0));
  EXPECT_TRUE(seams_of(three).empty());
  // Both sides face the same way: one of them would have to turn over.
  TriangleMesh turned = two_grids();
  for (std::size_t t = 8; t < 16; ++t) std::swap(turned.triangles[t][0], turned.triangles[t][1]);
  EXPECT_TRUE(seams_of(turned).empty());
}

TEST(VerticesAlong, AreAChainOfEdgesOfTheLevel) {
  constexpr int kLevel = 3;
  for (const test::Shape& shape : test::base_shapes()) {
    surface::ProgressiveSurface surface({topology_of(shape.mesh), flat(shape.mesh), kLevel});
    std::vector<Triangle> triangles(surface.counts(kLevel).triangles);
    ASSERT_TRUE(surface.write_triangles(kLevel, triangles.data()->data()));
    std::set<std::array<std::uint32_t, 2>> sides;
    for (const Triangle& t : triangles)
      for (std::size_t k = 0; k < 3; ++k)
        sides.insert({std::min(t[k], t[(k + 1) % 3]), std::max(t[k], t[(k + 1) % 3])});
    const auto edges = bitstream::number_base_edges(topology_of(shape.mesh)).edges;
    for (std::uint32_t e = 0; e < edges.size(); ++e) {
      const auto chain = vertices_along(e, edges[e], surface.counts(0), kLevel);
      ASSERT_EQ(chain.size(), 9u);
      EXPECT_EQ(chain.front(), edges[e].vertices[0]);
      EXPECT_EQ(chain.back(), edges[e].vertices[1]);
      EXPECT_EQ(chain[4], surface.counts(0).vertices + e);
      for (std::size_t i = 0; i + 1 < chain.size(); ++i)
        EXPECT_TRUE(
            sides.contains({std::min(chain[i], chain[i + 1]), std::max(chain[i], chain[i + 1])}))
            << shape.name << ", edge " << e << ", step " << i;
    }
  }
}

TEST(SeamCheck, MeasuresTheWidestGapOfEachKind) {
  constexpr int kLevel = 2;
  const TriangleMesh mesh = two_grids();
  const auto edges = bitstream::number_base_edges(topology_of(mesh)).edges;
  const surface::LevelCounts base{mesh.positions.size(), edges.size(), mesh.triangles.size()};
  std::vector<float> limits(3 * surface::refined_counts(base, kLevel).vertices, 1.0f);
  const std::vector<std::uint64_t> ends{8, 16};
  const SeamCheck between(edges, base, flat(mesh), ends, kLevel);
  const SeamCheck within(edges, base, flat(mesh), {}, kLevel);
  ASSERT_EQ(between.seams().size(), 2u);
  EXPECT_TRUE(between.is_between_primitives(0));
  EXPECT_FALSE(within.is_between_primitives(0));
  EXPECT_EQ(between.measure(limits).between_primitives.distance, 0);

  const auto chain =
      vertices_along(between.seams()[1].edges[0], edges[between.seams()[1].edges[0]], base, kLevel);
  limits[3 * chain[1] + 2] += 0.25f;
  EXPECT_NEAR(between.measure(limits).between_primitives.distance, 0.25f, 1e-6f);
  EXPECT_EQ(between.measure(limits).between_primitives.seam, 1u);
  EXPECT_EQ(between.measure(limits).within_primitive.distance, 0);
  EXPECT_NEAR(within.measure(limits).within_primitive.distance, 0.25f, 1e-6f);
}

}  // namespace
}  // namespace zerotree::validate
