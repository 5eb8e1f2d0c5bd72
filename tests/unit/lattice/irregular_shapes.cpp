#include "irregular_shapes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

namespace zerotree::test {

namespace {

using Edge = std::array<std::uint32_t, 2>;

Shape make_shape(const std::string& name, TriangleMesh mesh, std::vector<Edge> creases = {},
                 std::vector<std::uint32_t> corners = {}) {
  for (Edge& edge : creases) std::sort(edge.begin(), edge.end());
  std::sort(creases.begin(), creases.end());
  return {name, add_noise(std::move(mesh), 0.1, 7), creases, corners};
}

/// All edges between neighbours in the list.
std::vector<Edge> path(const std::vector<std::uint32_t>& vertices) {
  std::vector<Edge> edges;
  for (std::size_t i = 1; i < vertices.size(); ++i) edges.push_back({vertices[i - 1], vertices[i]});
  return edges;
}

TriangleMesh open_ring(int segments) {
  TriangleMesh mesh;
  const auto n = static_cast<std::uint32_t>(segments);
  for (std::uint32_t i = 0; i < n; ++i) {
    const double angle = 2 * std::numbers::pi * i / segments;
    mesh.positions.emplace_back(std::cos(angle), std::sin(angle), 0.0);
    mesh.positions.emplace_back(std::cos(angle), std::sin(angle), 1.0);
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t low = 2 * i, next = 2 * ((i + 1) % n);
    mesh.triangles.push_back({low, next, low + 1});
    mesh.triangles.push_back({next, next + 1, low + 1});
  }
  return mesh;
}

TriangleMesh all_valences() {
  TriangleMesh mesh = bipyramid(3);
  for (int valence = 4; valence <= 12; ++valence)
    mesh = disjoint_union(mesh, bipyramid(valence), {0.2 * (valence - 3), 0, 0});
  return mesh;
}

}  // namespace

std::vector<Shape> irregular_shapes() {
  std::vector<Shape> shapes;
  // The neighbours of vertex 0, all of valence 5.
  shapes.push_back(make_shape("crease_circle", icosahedron(), path({11, 5, 1, 7, 10, 11})));
  shapes.push_back(make_shape("darts", icosahedron(), path({0, 5, 4, 3})));
  // Of a grid of 5 x 4 vertices: from boundary to boundary, and one that ends inside.
  auto to_boundary = path({1, 6, 11, 16});
  to_boundary.push_back({9, 8});
  shapes.push_back(make_shape("crease_to_boundary", grid(4, 3), to_boundary));
  auto star = path({0, 5, 4});
  for (const Edge& edge :
       {Edge{0, 1}, Edge{0, 10}, Edge{2, 3}, Edge{2, 4}, Edge{2, 6}, Edge{2, 11}})
    star.push_back(edge);
  shapes.push_back(make_shape("crease_star", icosahedron(), star));
  // Inside, in the middle of a boundary, at the end of a crease.
  shapes.push_back(make_shape("tagged_corners", grid(4, 3), path({6, 7, 8}), {2, 6, 12}));
  shapes.push_back(make_shape("valences", all_valences()));
  shapes.push_back(make_shape("open_ring", open_ring(5)));
  shapes.push_back(make_shape("one_triangle", {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}));
  return shapes;
}

}  // namespace zerotree::test
