// Base meshes made for single rules of the specification, beside those of the tests' support.
#pragma once

#include <cstdint>
#include <vector>

#include "shapes.h"

namespace zerotree::conformance {

/// A wavy square with darts, a crease from the boundary inwards, a closed crease, three creases in
/// one vertex, and tagged corners: on a smooth place, on a boundary and on a crease.
test::Shape crease_grid();
/// An octahedron whose equator is a crease.
test::Shape crease_circle();
/// Two poles over rings of 3, 5, 8 and 12 vertices: four components.
test::Shape many_valences();
/// A sphere with edges turned at random, valence 3 to 14; `holes` triangles are missing, and a
/// `share` of edges and vertices is tagged.
test::Shape wild_sphere(int times, std::uint32_t holes, double share, std::uint32_t seed);
/// A sphere with edges turned at random whose triangles are divided in three, twice: most vertices
/// have only neighbours that come before them.
test::Shape stellated_sphere();
/// Strips of these numbers of squares, each closed to a ring, on a grid of integers.
test::Shape rings(const std::vector<int>& lengths);
/// One triangle.
test::Shape triangle();
/// One of the bases of tests/fuzz: 0 closed, 1 bounded, 2 two components, 3 with creases.
test::Shape small_base(int number, const std::string& name);

}  // namespace zerotree::conformance
