// From base control points and details to the surface (paper, equation 1 and section 3.3).
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "bitstream/coefficient_layout.h"
#include "surface/detail_weights.h"
#include "surface/limit_output.h"
#include "surface/subdivision_hierarchy.h"

namespace zerotree::surface {

/// Positions are x, y, z of each vertex in a row; a level's have 3 * vertex_count floats.
using Positions = std::vector<float>;
/// The details of a level in local frames: normal, tangent 1, tangent 2 of each edge in
/// OpenSubdiv's numbering; 3 * edge_count floats.
using LocalDetails = std::vector<float>;

/// P of `level`: control points of the next finer level without details.
Positions subdivide(const SubdivisionLevel& level, const Positions& coarse);

/// The details of a level in global axes: x, y, z of each edge.
using Moves = std::vector<float>;

/// The moves that `details`, as `dequantise` gives them, stand for in frames and areas of
/// `predicted`, which is what `subdivide` returned. `mean_area` is that of the level's triangles.
Moves detail_moves(const SubdivisionLevel& level, const LocalDetails& details, double mean_area,
                   const Positions& predicted);

/// Adds Q of `level` times the moves to `fine`.
void add_details(const SubdivisionLevel& level, const Moves& moves, Positions& fine);

/// The lengths that the integers of one level stand for where the area weight is 1. `level` is
/// below both the coefficients' and the hierarchy's levels.
LocalDetails dequantise(const SubdivisionHierarchy& hierarchy,
                        const bitstream::CoefficientSet& coefficients,
                        const Dequantisation& dequantisation, int level);

/// Control points of `level`, 0 .. hierarchy.levels(). Finer levels are not computed; a level
/// beyond the coefficients' is subdivided on. Costs about 50 ns per vertex plus 100 ns per detail
/// that is not zero.
Positions reconstruct(const SubdivisionHierarchy& hierarchy, const Positions& base_control_points,
                      const bitstream::CoefficientSet& coefficients,
                      const Dequantisation& dequantisation, int level);

/// Limit positions and unit limit normals of the surface at the vertices of `level`, from that
/// level's control points. Where the tangents vanish the normal is that of a fixed frame: always
/// finite and of length 1.
void limit_surface(const SubdivisionLevel& level, const Positions& control_points,
                   StridedVectors positions, StridedVectors normals);

}  // namespace zerotree::surface
