// Meshes of every class the stages must handle, made in code.
#pragma once

#include <array>
#include <cstdint>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "mesh/triangle_mesh.h"

namespace zerotree::test {

/// A mesh with the tags a base mesh carries. Edges are (lower, higher) vertex, ascending.
struct Shape {
  std::string name;
  TriangleMesh mesh;
  std::vector<std::array<std::uint32_t, 2>> crease_edges;
  std::vector<std::uint32_t> corner_vertices;
};

/// How a test's report names a shape.
inline void PrintTo(const Shape& shape, std::ostream* out) { *out << shape.name; }

TriangleMesh tetrahedron();
TriangleMesh octahedron();
/// Unit icosahedron: all valences 5.
TriangleMesh icosahedron();
/// `columns` x `rows` squares in the plane z = 0, two triangles each, unit squares.
TriangleMesh grid(int columns, int rows);
/// The boundary surface of a set of unit cubes, two triangles a square face: a closed manifold if
/// no two cubes touch only along an edge or a corner.
TriangleMesh voxel_surface(const std::vector<std::array<int, 3>>& cubes);
/// Two poles of `valence` over a ring of `valence` vertices of valence 4.
TriangleMesh bipyramid(int valence);
/// Two meshes as one, with no common vertex; `b` is moved by `offset`.
TriangleMesh disjoint_union(const TriangleMesh& a, const TriangleMesh& b,
                            const Eigen::Vector3d& offset);

/// One base mesh of each class: closed ("icosahedron"), bounded ("grid"), creased ("cube": its 12
/// edges are creases, its 8 vertices corners), genus 2 ("double_torus"), several components
/// ("two_components": one closed, one bounded), valence 3 to 12 ("tetrahedron", "bipyramid12").
std::vector<Shape> base_shapes();

/// `mesh` quadrisected `times` times; new vertices at the edge midpoints.
TriangleMesh midpoint_subdivide(const TriangleMesh& mesh, int times);
/// Every vertex moved by a smooth wave along its normal: relative to the bounding box diagonal.
TriangleMesh add_bumps(TriangleMesh mesh, double amplitude, double waves);
/// Every vertex moved by a uniform random vector of at most `amplitude` times the mean edge.
TriangleMesh add_noise(TriangleMesh mesh, double amplitude, std::uint32_t seed);
/// An icosphere of radius 1 and 10 * 4^times + 2 vertices.
TriangleMesh sphere(int times);

}  // namespace zerotree::test
