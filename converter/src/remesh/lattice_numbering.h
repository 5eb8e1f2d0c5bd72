// Which finest vertex is which lattice point of which base triangle.
#pragma once

#include <cstdint>
#include <vector>

#include "bitstream/base_topology.h"

namespace zerotree::remesh {

/// The vertices of a base mesh quadrisected `levels` times, numbered as SemiRegularMesh says.
struct LatticeNumbering {
  int levels = 0;
  std::uint32_t vertex_count = 0;
  /// Per base triangle the vertices of its lattice of step 2^-levels, by rows of constant y.
  std::vector<std::uint32_t> vertices;

  std::uint32_t steps() const { return 1u << levels; }
  std::size_t points_per_triangle() const { return std::size_t{steps() + 1} * (steps() + 2) / 2; }
  /// The vertex at lattice point (i, j) / 2^levels of the chart of base triangle `triangle`.
  std::uint32_t at(std::uint32_t triangle, std::uint32_t i, std::uint32_t j) const {
    return vertices[triangle * points_per_triangle() + row_offset(j) + i];
  }
  std::size_t row_offset(std::uint32_t j) const {
    return std::size_t{j} * (steps() + 1) - std::size_t{j} * (j - 1) / 2;
  }
};

/// Numbers the vertices. 4 to 8 bytes a finest vertex are kept, about 25 more in passing.
LatticeNumbering number_lattices(const bitstream::BaseTopology& base, int levels);

/// Vertices after `levels` quadrisections.
std::uint64_t count_finest_vertices(const bitstream::BaseTopology& base, int levels);

}  // namespace zerotree::remesh
