// The levels' connectivity is OpenSubdiv's and that of the lattices.
#include "relax/subdivided_levels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "bitstream/base_edges.h"
#include "remesh/lattice_numbering.h"
#include "shapes.h"
#include "surface/loop_refiner.h"

namespace zerotree::test {
namespace {

using relax::SubdividedLevel;

constexpr int kLevels = 3;

bitstream::BaseTopology topology_of(const Shape& shape) {
  return {static_cast<std::uint32_t>(shape.mesh.positions.size()), shape.mesh.triangles,
          shape.crease_edges, shape.corner_vertices};
}

template <class Indices>
std::vector<std::uint32_t> numbers(const Indices& indices) {
  std::vector<std::uint32_t> numbers;
  for (int i = 0; i < indices.size(); ++i)
    numbers.push_back(static_cast<std::uint32_t>(indices[i]));
  return numbers;
}

template <std::size_t N>
std::vector<std::uint32_t> numbers(const std::array<std::uint32_t, N>& indices) {
  return {indices.begin(), indices.end()};
}

class SubdividedLevels : public testing::TestWithParam<Shape> {};

TEST_P(SubdividedLevels, AreOpenSubdivs) {
  const bitstream::BaseTopology base = topology_of(GetParam());
  const std::vector<SubdividedLevel> levels = relax::subdivide_base(base, kLevels);
  ASSERT_EQ(levels.size(), kLevels + 1u);
  const auto refiner =
      surface::make_loop_refiner(base, bitstream::number_base_edges(base).edges, kLevels);
  for (int l = 0; l <= kLevels; ++l) {
    SCOPED_TRACE(l);
    const surface::RefinerLevel& expected = refiner->GetLevel(l);
    const SubdividedLevel& level = levels[static_cast<std::size_t>(l)];
    ASSERT_EQ(static_cast<int>(level.vertex_count), expected.GetNumVertices());
    ASSERT_EQ(static_cast<int>(level.triangles.size()), expected.GetNumFaces());
    ASSERT_EQ(static_cast<int>(level.face_edges.size()), expected.GetNumFaces());
    ASSERT_EQ(static_cast<int>(level.edges.size()), expected.GetNumEdges());
    ASSERT_EQ(static_cast<int>(level.is_feature.size()), expected.GetNumEdges());
    for (int f = 0; f < expected.GetNumFaces(); ++f) {
      const auto face = static_cast<std::size_t>(f);
      ASSERT_EQ(numbers(level.triangles[face]), numbers(expected.GetFaceVertices(f)));
      ASSERT_EQ(numbers(level.face_edges[face]), numbers(expected.GetFaceEdges(f)));
    }
    for (int e = 0; e < expected.GetNumEdges(); ++e) {
      const auto edge = static_cast<std::size_t>(e);
      std::vector<std::uint32_t> ends = numbers(level.edges[edge]);
      std::vector<std::uint32_t> expected_ends = numbers(expected.GetEdgeVertices(e));
      std::ranges::sort(ends);
      std::ranges::sort(expected_ends);
      ASSERT_EQ(ends, expected_ends);
      ASSERT_EQ(level.is_feature[edge] != 0, surface::is_sharp(expected, e));
    }
  }
}

// The finest faces are the lattices' small triangles, as oriented there.
TEST_P(SubdividedLevels, AreTheLattices) {
  const bitstream::BaseTopology base = topology_of(GetParam());
  const auto in_order = [](Triangle t) {
    std::ranges::rotate(t, std::ranges::min_element(t));
    return t;
  };
  std::multiset<Triangle> faces, expected;
  const SubdividedLevel finest = relax::subdivide_base(base, kLevels).back();
  for (const Triangle& t : finest.triangles) faces.insert(in_order(t));
  const remesh::LatticeNumbering at = remesh::number_lattices(base, kLevels);
  EXPECT_EQ(finest.vertex_count, at.vertex_count);
  for (std::uint32_t t = 0; t < base.triangles.size(); ++t)
    for (std::uint32_t j = 0; j < at.steps(); ++j)
      for (std::uint32_t i = 0; i + j < at.steps(); ++i) {
        expected.insert(in_order({at.at(t, i, j), at.at(t, i + 1, j), at.at(t, i, j + 1)}));
        if (i + j + 1 == at.steps()) continue;
        expected.insert(in_order({at.at(t, i + 1, j), at.at(t, i + 1, j + 1), at.at(t, i, j + 1)}));
      }
  EXPECT_EQ(faces, expected);
}

INSTANTIATE_TEST_SUITE_P(Shapes, SubdividedLevels, testing::ValuesIn(base_shapes()),
                         [](const auto& shape) { return shape.param.name; });

}  // namespace
}  // namespace zerotree::test
