// A sparse system solved for the three coordinates of points.
#pragma once

#include <Eigen/Core>
#include <array>

#include "analysis/level_split.h"
#include "analysis/synthesis_matrix.h"

namespace zerotree::analysis {

/// Solves matrix x = right for each coordinate by BiCGSTAB, starting from `guess`. The result does
/// not depend on the number of threads. Throws Error (internal) if it does not converge.
std::array<Eigen::VectorXd, 3> solve_coordinates(const SparseMatrix& matrix,
                                                 const std::array<Eigen::VectorXd, 3>& right,
                                                 const std::array<Eigen::VectorXd, 3>& guess,
                                                 const SplitOptions& options);

}  // namespace zerotree::analysis
