// The base mesh as a surface of unit equilateral triangles.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "bitstream/base_topology.h"
#include "domain/domain.h"
#include "remesh/lattice_isometry.h"

namespace zerotree::remesh {

using domain::kNext;
using domain::kNone;
using domain::kPrev;

/// The base mesh in its final order. The chart of a triangle puts its corners 0, 1, 2 at (0,0),
/// (1,0), (0,1).
struct BaseDomain {
  bitstream::BaseTopology topology;
  /// Across edge k (corner k to k + 1) of each triangle: the triangle there, kNone at the boundary,
  /// and the map from this triangle's chart to that one's.
  std::vector<std::array<std::uint32_t, 3>> adjacent;
  std::vector<std::array<LatticeIsometry, 3>> transitions;
  /// Of each base vertex: the mesh vertex that it is at first (cone swaps change it).
  std::vector<std::uint32_t> mesh_vertex;
  /// Of each base triangle: the mesh face that it is at first, and which of that face's corners
  /// is its corner 0.
  std::vector<std::uint32_t> mesh_face;
  std::vector<std::uint8_t> first_corner;
};

/// From the chart with corner `k` of a base triangle at (0,0) and corner k + 1 at (1,0) to the
/// triangle's own.
LatticeIsometry corner_chart(int k);

/// The base of `domain` in the order of the stream's connectivity coder.
BaseDomain build_base_domain(const domain::Domain& domain);

/// A place of the base surface.
struct BasePlace {
  std::uint32_t triangle = kNone;
  LatticePoint point = LatticePoint::Zero();  ///< in the triangle's chart
  LatticeIsometry map;                        ///< from the chart the walk began in
};

/// Walks straight from `from`, a point of `triangle`, to `to`, both in that triangle's chart, over
/// base edges. Stops at the boundary.
BasePlace walk(const BaseDomain& base, std::uint32_t triangle, const LatticePoint& from,
               const LatticePoint& to);

/// Whether `p` lies in the closed base triangle of its chart.
inline bool is_inside(const LatticePoint& p) {
  return p.x() >= 0 && p.y() >= 0 && p.x() + p.y() <= 1;
}

}  // namespace zerotree::remesh
