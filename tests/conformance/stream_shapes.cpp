#include "stream_shapes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "bitstream/base_topology.h"
#include "fuzz_bases.h"
#include "random_topology.h"

namespace zerotree::conformance {
namespace {

using Edge = std::array<std::uint32_t, 2>;

void add_crease(test::Shape& shape, const std::vector<std::uint32_t>& path) {
  for (std::size_t i = 1; i < path.size(); ++i)
    shape.crease_edges.push_back({std::min(path[i - 1], path[i]), std::max(path[i - 1], path[i])});
  std::sort(shape.crease_edges.begin(), shape.crease_edges.end());
}

TriangleMesh ring(int length) {
  TriangleMesh mesh;
  const auto count = static_cast<std::uint32_t>(length);
  for (std::uint32_t i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * i / length;
    const double x = std::round(100 * std::cos(angle)), y = std::round(100 * std::sin(angle));
    mesh.positions.emplace_back(x, y, i % 3);
    mesh.positions.emplace_back(x, y, 10 + i % 4);
    const std::uint32_t a = 2 * i, b = 2 * ((i + 1) % count);
    mesh.triangles.push_back({a, b, a + 1});
    mesh.triangles.push_back({b, b + 1, a + 1});
  }
  return mesh;
}

}  // namespace

test::Shape crease_grid() {
  test::Shape shape{"crease_grid", test::grid(6, 6), {}, {}};
  for (Eigen::Vector3d& p : shape.mesh.positions)
    p.z() = 0.25 * (static_cast<int>(p.x() * p.y()) % 3);
  const auto at = [](std::uint32_t x, std::uint32_t y) { return 7 * y + x; };
  add_crease(shape, {at(1, 1), at(2, 1), at(3, 1)});
  add_crease(shape, {at(0, 3), at(1, 3), at(2, 3)});
  add_crease(shape, {at(5, 4), at(5, 5), at(4, 5), at(3, 4), at(3, 3), at(4, 3), at(5, 4)});
  add_crease(shape, {at(1, 5), at(2, 5), at(3, 5)});
  add_crease(shape, {at(2, 5), at(2, 4)});
  shape.corner_vertices = {at(3, 0), at(5, 2), at(5, 4)};
  return shape;
}

test::Shape crease_circle() {
  test::Shape shape{"crease_circle", test::octahedron(), {}, {}};
  add_crease(shape, {0, 1, 2, 3, 0});
  // So that it fits a cube around the origin: where nothing is known of positions, all are 0.
  for (Eigen::Vector3d& p : shape.mesh.positions) p *= 0.99;
  return shape;
}

test::Shape many_valences() {
  TriangleMesh mesh = test::bipyramid(3);
  double offset = 0;
  for (const int valence : {5, 8, 12})
    mesh = test::disjoint_union(mesh, test::bipyramid(valence), {offset += 2.5, 0, 0});
  return {"many_valences", mesh, {}, {}};
}

test::Shape wild_sphere(int times, std::uint32_t holes, double share, std::uint32_t seed) {
  test::Shape shape{"wild_sphere", test::sphere(times), {}, {}};
  const auto vertices = static_cast<std::uint32_t>(shape.mesh.positions.size());
  bitstream::BaseTopology base{vertices, shape.mesh.triangles, {}, {}};
  base = test::flip_edges(base, 12 * vertices, 3, 14, seed);
  base = test::punch_holes(std::move(base), holes, seed);
  base = test::tag_randomly(std::move(base), share, seed);
  shape.mesh.triangles = base.triangles;
  shape.crease_edges = base.crease_edges;
  shape.corner_vertices = base.corner_vertices;
  return shape;
}

test::Shape stellated_sphere() {
  test::Shape shape{"stellated_sphere", test::icosahedron(), {}, {}};
  const bitstream::BaseTopology base{12, shape.mesh.triangles, {}, {}};
  shape.mesh.triangles = test::flip_edges(base, 144, 3, 40, 5).triangles;
  for (int times = 0; times < 2; ++times) {
    TriangleMesh fine{shape.mesh.positions, {}};
    for (const auto& [a, b, c] : shape.mesh.triangles) {
      const auto middle = static_cast<std::uint32_t>(fine.positions.size());
      const auto& p = shape.mesh.positions;
      fine.positions.push_back((p[a] + p[b] + p[c]) / 3);
      fine.triangles.insert(fine.triangles.end(), {{a, b, middle}, {b, c, middle}, {c, a, middle}});
    }
    shape.mesh = std::move(fine);
  }
  return shape;
}

test::Shape rings(const std::vector<int>& lengths) {
  TriangleMesh mesh;
  for (std::size_t i = 0; i < lengths.size(); ++i)
    mesh = test::disjoint_union(mesh, ring(lengths[i]), {0, 0, 25.0 * static_cast<double>(i)});
  return {"rings", mesh, {}, {}};
}

test::Shape triangle() {
  return {"triangle", {{{0, 0, 0}, {1, 0, 0.25}, {0.25, 1, 0}}, {{0, 1, 2}}}, {}, {}};
}

test::Shape small_base(int number, const std::string& name) {
  const fuzz::FuzzBase known = fuzz::fuzz_base(number);
  test::Shape shape{name, {}, known.crease_edges, {}};
  for (std::size_t i = 0; i < known.positions.size(); i += 3)
    shape.mesh.positions.emplace_back(known.positions[i], known.positions[i + 1],
                                      known.positions[i + 2]);
  for (std::size_t i = 0; i < known.indices.size(); i += 3)
    shape.mesh.triangles.push_back({known.indices[i], known.indices[i + 1], known.indices[i + 2]});
  return shape;
}

}  // namespace zerotree::conformance
