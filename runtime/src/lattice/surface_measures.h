// Measures of a surface: a box around it, and what coarser samplings of it lose.
#pragma once

#include <span>

#include "lattice/lattice_mesh.h"
#include "lattice/lattice_points.h"
#include "lattice/level_details.h"

namespace zerotree::surface {

/// Longest move of any detail of a level with `cells` cells, from above.
float longest_move(const LevelDetails& details, std::size_t cells);
/// How far moves of at most 1 take any point, from above: at an even vertex with all its edges'
/// details dip and lift add up.
inline constexpr float kReachOfMoves = 2.5f;

/// How far the triangles of `level` are at most from those of the next, point by point: from even
/// vertices to themselves, from odd ones to the middle of their edge. `coarse` and `fine` are x, y,
/// z of each vertex of the two levels; the mesh knows both.
float longest_step(const LatticeMesh& mesh, int level, std::span<const float> coarse,
                   std::span<const float> fine);

}  // namespace zerotree::surface
