#include "shapes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <set>

namespace zerotree::test {
namespace {

using Edge = std::array<std::uint32_t, 2>;

Edge edge_of(std::uint32_t a, std::uint32_t b) {
  return {std::min(a, b), std::max(a, b)};
}

std::uint32_t index_of(std::size_t size) {
  return static_cast<std::uint32_t>(size);
}

std::vector<Eigen::Vector3d> vertex_normals(const TriangleMesh& mesh) {
  std::vector<Eigen::Vector3d> normals(mesh.positions.size(), Eigen::Vector3d::Zero());
  for (const Triangle& t : mesh.triangles) {
    const Eigen::Vector3d n = (mesh.positions[t[1]] - mesh.positions[t[0]])
                                  .cross(mesh.positions[t[2]] - mesh.positions[t[0]]);
    for (std::uint32_t v : t) normals[v] += n;
  }
  for (Eigen::Vector3d& n : normals) n.normalize();
  return normals;
}

// Edges between triangles of different planes, and the vertices where three or more of them meet.
void tag_creases(Shape& shape) {
  std::map<Edge, std::vector<Eigen::Vector3d>> normals;
  const TriangleMesh& mesh = shape.mesh;
  for (const Triangle& t : mesh.triangles) {
    const Eigen::Vector3d n = (mesh.positions[t[1]] - mesh.positions[t[0]])
                                  .cross(mesh.positions[t[2]] - mesh.positions[t[0]])
                                  .normalized();
    for (int k = 0; k < 3; ++k) normals[edge_of(t[k], t[(k + 1) % 3])].push_back(n);
  }
  std::map<std::uint32_t, int> creases_at;
  for (const auto& [edge, sides] : normals) {
    if (sides.size() != 2 || sides[0].dot(sides[1]) > 0.9) continue;
    shape.crease_edges.push_back(edge);
    for (std::uint32_t v : edge) ++creases_at[v];
  }
  for (const auto& [v, count] : creases_at)
    if (count >= 3) shape.corner_vertices.push_back(v);
}

}  // namespace

TriangleMesh tetrahedron() {
  return {{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}},
          {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}}};
}

TriangleMesh octahedron() {
  return bipyramid(4);
}

TriangleMesh icosahedron() {
  const double g = std::numbers::phi;
  TriangleMesh mesh{
      {{-1, g, 0},
       {1, g, 0},
       {-1, -g, 0},
       {1, -g, 0},
       {0, -1, g},
       {0, 1, g},
       {0, -1, -g},
       {0, 1, -g},
       {g, 0, -1},
       {g, 0, 1},
       {-g, 0, -1},
       {-g, 0, 1}},
      {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
       {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
       {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};
  for (Eigen::Vector3d& p : mesh.positions) p.normalize();
  return mesh;
}

TriangleMesh grid(int columns, int rows) {
  TriangleMesh mesh;
  for (int y = 0; y <= rows; ++y)
    for (int x = 0; x <= columns; ++x) mesh.positions.emplace_back(x, y, 0.0);
  const auto at = [&](int x, int y) { return static_cast<std::uint32_t>(y * (columns + 1) + x); };
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x) {
      mesh.triangles.push_back({at(x, y), at(x + 1, y), at(x + 1, y + 1)});
      mesh.triangles.push_back({at(x, y), at(x + 1, y + 1), at(x, y + 1)});
    }
  return mesh;
}

TriangleMesh voxel_surface(const std::vector<std::array<int, 3>>& cubes) {
  const std::set<std::array<int, 3>> filled(cubes.begin(), cubes.end());
  std::map<std::array<int, 3>, std::uint32_t> vertices;
  TriangleMesh mesh;
  const auto vertex = [&](std::array<int, 3> p) {
    const auto [it, is_new] = vertices.try_emplace(p, index_of(mesh.positions.size()));
    if (is_new) mesh.positions.emplace_back(p[0], p[1], p[2]);
    return it->second;
  };
  for (const std::array<int, 3>& cube : filled)
    for (int axis = 0; axis < 3; ++axis)
      for (int side = 0; side < 2; ++side) {
        std::array<int, 3> neighbour = cube;
        neighbour[axis] += side == 1 ? 1 : -1;
        if (filled.contains(neighbour)) continue;
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        std::array<std::uint32_t, 4> quad;
        for (int k = 0; k < 4; ++k) {
          std::array<int, 3> p = cube;
          p[axis] += side;
          p[u] += k == 1 || k == 2;
          p[v] += k >= 2;
          quad[k] = vertex(p);
        }
        if (side == 0) std::swap(quad[1], quad[3]);
        mesh.triangles.push_back({quad[0], quad[1], quad[2]});
        mesh.triangles.push_back({quad[0], quad[2], quad[3]});
      }
  return mesh;
}

TriangleMesh bipyramid(int valence) {
  TriangleMesh mesh;
  for (int i = 0; i < valence; ++i) {
    const double angle = 2 * std::numbers::pi * i / valence;
    mesh.positions.emplace_back(std::cos(angle), std::sin(angle), 0.0);
  }
  mesh.positions.emplace_back(0, 0, 1);
  mesh.positions.emplace_back(0, 0, -1);
  const auto n = static_cast<std::uint32_t>(valence);
  for (std::uint32_t i = 0; i < n; ++i) {
    mesh.triangles.push_back({i, (i + 1) % n, n});
    mesh.triangles.push_back({(i + 1) % n, i, n + 1});
  }
  return mesh;
}

TriangleMesh disjoint_union(const TriangleMesh& a, const TriangleMesh& b,
                            const Eigen::Vector3d& offset) {
  TriangleMesh mesh = a;
  const std::uint32_t first = index_of(a.positions.size());
  for (const Eigen::Vector3d& p : b.positions) mesh.positions.push_back(p + offset);
  for (const Triangle& t : b.triangles)
    mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  return mesh;
}

std::vector<Shape> base_shapes() {
  std::vector<Shape> shapes;
  const auto add = [&](const std::string& name, TriangleMesh mesh) -> Shape& {
    return shapes.emplace_back(Shape{name, std::move(mesh), {}, {}});
  };
  add("icosahedron", icosahedron());
  add("grid", grid(4, 3));
  tag_creases(add("cube", voxel_surface({{0, 0, 0}})));
  std::vector<std::array<int, 3>> frame;
  for (int x = 0; x < 5; ++x)
    for (int y = 0; y < 3; ++y)
      if (y != 1 || x % 2 == 0) frame.push_back({x, y, 0});
  add("double_torus", voxel_surface(frame));
  add("two_components", disjoint_union(octahedron(), grid(3, 2), {4, 0, 0}));
  add("tetrahedron", tetrahedron());
  add("bipyramid12", bipyramid(12));
  return shapes;
}

TriangleMesh midpoint_subdivide(const TriangleMesh& mesh, int times) {
  TriangleMesh coarse = mesh;
  for (int i = 0; i < times; ++i) {
    TriangleMesh fine;
    fine.positions = coarse.positions;
    std::map<Edge, std::uint32_t> midpoints;
    const auto midpoint = [&](std::uint32_t a, std::uint32_t b) {
      const auto [it, is_new] =
          midpoints.try_emplace(edge_of(a, b), index_of(fine.positions.size()));
      if (is_new) fine.positions.push_back((coarse.positions[a] + coarse.positions[b]) / 2);
      return it->second;
    };
    for (const auto& [a, b, c] : coarse.triangles) {
      const std::uint32_t ab = midpoint(a, b), bc = midpoint(b, c), ca = midpoint(c, a);
      fine.triangles.insert(fine.triangles.end(),
                            {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {bc, ca, ab}});
    }
    coarse = std::move(fine);
  }
  return coarse;
}

TriangleMesh add_bumps(TriangleMesh mesh, double amplitude, double waves) {
  const double diagonal = bounding_box_diagonal(mesh.positions);
  const std::vector<Eigen::Vector3d> normals = vertex_normals(mesh);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const Eigen::Vector3d p = mesh.positions[i] * (2 * std::numbers::pi * waves / diagonal);
    mesh.positions[i] += normals[i] * amplitude * diagonal *
                         (std::sin(p.x()) + std::sin(p.y() + 1) + std::sin(p.z() + 2)) / 3;
  }
  return mesh;
}

TriangleMesh add_noise(TriangleMesh mesh, double amplitude, std::uint32_t seed) {
  double edge_sum = 0;
  for (const Triangle& t : mesh.triangles)
    edge_sum += (mesh.positions[t[0]] - mesh.positions[t[1]]).norm();
  const double reach = amplitude * edge_sum / static_cast<double>(mesh.triangles.size());
  std::mt19937 random(seed);
  // std::uniform_real_distribution differs between libraries; these tests want the same mesh.
  const auto next = [&] { return (static_cast<double>(random()) * 0x1p-32 * 2 - 1) * reach; };
  for (Eigen::Vector3d& p : mesh.positions) {
    const double x = next(), y = next(), z = next();
    p += Eigen::Vector3d(x, y, z);
  }
  return mesh;
}

TriangleMesh sphere(int times) {
  TriangleMesh mesh = midpoint_subdivide(icosahedron(), times);
  for (Eigen::Vector3d& p : mesh.positions) p.normalize();
  return mesh;
}

}  // namespace zerotree::test
