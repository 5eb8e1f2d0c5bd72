// The subdivided interior of one base triangle: what is the same for all of them.
//
// Inside a base triangle everything is regular: at level j its points form a triangular lattice of
// n = 2^j segments a side. Point (a, b), a + b <= n, lies a steps from corner 0 towards corner 1
// and b steps towards corner 2. Side k runs from corner k to corner (k + 1) mod 3; with the
// triangle to its left. Points are numbered as OpenSubdiv's uniform refinement of a single triangle
// does, so a point keeps its number at all finer levels and one table serves all triangles.
#pragma once

#include <array>
#include <cstdint>
#include <memory_resource>
#include <vector>

namespace zerotree::surface {

/// An edge inside the lattice of one level. It runs parallel to side `side`, the same way.
struct LatticeEdge {
  std::uint32_t odd;  ///< its midpoint, a point of the next finer level
  std::uint32_t tail, head;
  std::uint32_t left, right;  ///< the opposite points of the two triangles
  /// Midpoints of the triangles' other edges: left near tail and head, right near tail and head.
  std::array<std::uint32_t, 4> wings;
  /// Its place in the image of the base edge (bitstream/coefficient_layout.h) that sees this
  /// triangle from its side 0 and from its side 1.
  std::array<std::uint32_t, 2> cells;
};

/// Points in a row that are in a row in the mesh too: those born at level `born` on edges that were
/// born inside the triangle at level `edge_born`, 1 <= edge_born < born.
struct PointRun {
  std::uint32_t first, count;
  int born, edge_born;
};

/// The lattice of one level.
struct LatticeLevel {
  explicit LatticeLevel(std::pmr::memory_resource* memory)
      : triangles(memory),
        runs(memory),
        rings(memory),
        side_points{Points(memory), Points(memory), Points(memory)},
        near_points{Points(memory), Points(memory), Points(memory)},
        edges{Edges(memory), Edges(memory), Edges(memory)} {}

  using Points = std::pmr::vector<std::uint32_t>;
  using Edges = std::pmr::vector<LatticeEdge>;

  int segments = 1;
  std::uint32_t point_count = 3;
  /// In the order of the children 4f .. 4f + 3; counter-clockwise.
  std::pmr::vector<std::array<std::uint32_t, 3>> triangles;
  /// All points inside, in ascending order without gap but for the sides' points.
  std::pmr::vector<PointRun> runs;
  /// Per point inside, in the order of `runs`: the point, then its six neighbours
  /// counter-clockwise from the direction of side 0.
  std::pmr::vector<std::array<std::uint32_t, 7>> rings;
  /// The points of each side from corner to corner.
  std::array<Points, 3> side_points;
  /// The points beside each side: the opposite points of the triangles at its segments.
  std::array<Points, 3> near_points;
  /// The edges inside, those parallel to side 0 first, then side 1, then side 2; empty at the
  /// finest level built.
  std::array<Edges, 3> edges;
};

/// Levels 0 .. `levels`. Costs about 0.1 microseconds and 100 bytes a point of the finest.
std::vector<LatticeLevel> triangle_lattices(int levels, std::pmr::memory_resource* memory);

/// Where the points inside a base edge of 2^level segments lie in the mesh, counted along the edge
/// from OpenSubdiv's first vertex: point i was born at level born[i] and is number[i] among those
/// born there on this edge. The ends have no entry of meaning.
struct EdgePoints {
  std::vector<int> born;
  std::vector<std::uint32_t> number;
};
EdgePoints edge_points(int level);

}  // namespace zerotree::surface
