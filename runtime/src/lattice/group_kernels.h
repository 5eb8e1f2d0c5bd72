// Synthesis inside base triangles, kLanes of them at once (paper, equation 1 and section 3.3).
//
// Only what lies inside is computed; it depends on the lattice alone, sides included. Arrays are
// one group's of LatticePoints: `coarse`, `lifts` of `level`, `fine` of `finer`, the next level.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "lattice/lanes.h"
#include "lattice/level_details.h"
#include "lattice/triangle_lattice.h"

namespace zerotree::surface {

/// fine = P coarse.
void subdivide_inside(const LatticeLevel& level, const LanePoint* coarse, LanePoint* fine);

/// Where the details of a group's edges are.
struct GroupDetails {
  /// The base edge that is side k of the triangle in a lane, and which of its sides the triangle
  /// is.
  struct Side {
    std::uint32_t base_edge;
    std::uint32_t seen_from;
  };
  std::array<std::array<Side, 3>, kLanes> sides;
  std::size_t lanes_used;
  const LevelDetails* details;
  double mean_area;
};

/// Adds to the odd points inside what their own details move them, in frames and areas of `fine`,
/// which is as `subdivide_inside` left it, sides included. Into `lifts` come the lifts of the even
/// points inside and, of those on the sides, the part of the edges inside; into `moves`, of
/// finer.point_count - level.point_count points, the moves.
void move_inside(const LatticeLevel& level, const LatticeLevel& finer, const GroupDetails& group,
                 LanePoint* moves, LanePoint* fine, LanePoint* lifts);

/// fine -= P lifts, and even points dip. `lifts` are complete, sides included.
void lift_inside(const LatticeLevel& level, const LanePoint* lifts, LanePoint* fine);

}  // namespace zerotree::surface
