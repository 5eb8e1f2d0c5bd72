// The wavelet synthesis of one level as a sparse matrix.
#pragma once

#include <Eigen/SparseCore>

#include "surface/subdivision_hierarchy.h"

namespace zerotree::analysis {

using SparseMatrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// [P Q] of `level` (paper, equation 1): square, rows are the vertices of the next finer level,
/// columns the vertices of this one followed by its edges. About 19 entries a row.
SparseMatrix synthesis_matrix(const surface::SubdivisionLevel& level);

/// The factors that bring the columns to comparable length: 1/2 for P, 1/|Q| for each of Q. With
/// them the condition number of the whole transform stays in the tens.
Eigen::VectorXd column_scales(const surface::SubdivisionLevel& level);

}  // namespace zerotree::analysis
