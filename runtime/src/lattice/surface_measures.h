// Measures of a surface: a box around it, and what coarser samplings of it lose.
#pragma once

#include <span>
#include <vector>

#include "lattice/lattice_mesh.h"
#include "lattice/lattice_points.h"
#include "lattice/level_details.h"

namespace zerotree::surface {

/// Longest move of any detail of a level with `cells` cells, from above.
float longest_move(const LevelDetails& details, std::size_t cells);
/// How far moves of at most 1 take any point, from above: at an even vertex with all its edges'
/// details dip and lift add up.
inline constexpr float kReachOfMoves = 2.5f;

/// Per level below the last of `mesh`: the longest distance between an odd vertex and the middle of
/// its edge in the sampled surface; `positions` are x, y, z of each vertex of level `level`.
std::vector<float> chord_heights(const LatticeMesh& mesh, int level,
                                 std::span<const float> positions);

}  // namespace zerotree::surface
