#include "analysis/synthesis_matrix.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace zerotree::analysis {

// Filled in two passes over the stencils, counting first: a list of triplets would take several
// times the matrix itself. Columns ascend in a row because details are visited in edge order.
SparseMatrix synthesis_matrix(const surface::SubdivisionLevel& level) {
  const auto& subdivision = level.subdivision;
  const auto& details = level.details;
  const std::size_t rows = subdivision.sizes.size();
  const auto size = static_cast<Eigen::Index>(rows);
  SparseMatrix matrix(size, size);
  matrix.resizeNonZeros(
      static_cast<Eigen::Index>(subdivision.indices.size() + details.indices.size()));
  int* begin = matrix.outerIndexPtr();
  std::fill(begin, begin + rows + 1, 0);
  for (std::size_t row = 0; row < rows; ++row) begin[row + 1] = subdivision.sizes[row];
  for (const std::uint32_t vertex : details.indices) ++begin[vertex + 1];
  std::partial_sum(begin, begin + rows + 1, begin);

  std::vector<int> next(begin, begin + rows);
  const auto add = [&](std::size_t row, int column, float weight) {
    matrix.innerIndexPtr()[next[row]] = column;
    matrix.valuePtr()[next[row]++] = static_cast<double>(weight);
  };
  for (std::size_t row = 0; row < rows; ++row) {
    const auto first = static_cast<std::size_t>(subdivision.offsets[row]);
    for (std::size_t k = first; k < first + static_cast<std::size_t>(subdivision.sizes[row]); ++k)
      add(row, subdivision.indices[k], subdivision.weights[k]);
  }
  for (std::size_t edge = 0; edge < details.row_count(); ++edge) {
    const float* weight = details.row_weights(edge);
    for (const std::uint32_t vertex : details.row_indices(edge))
      add(vertex, static_cast<int>(level.vertex_count + edge), *weight++);
  }
  return matrix;
}

Eigen::VectorXd column_scales(const surface::SubdivisionLevel& level) {
  const auto& details = level.details;
  Eigen::VectorXd scales(static_cast<Eigen::Index>(level.vertex_count + details.row_count()));
  scales.setConstant(0.5);
  for (std::size_t edge = 0; edge < details.row_count(); ++edge) {
    double squared = 0.0;
    const float* weights = details.row_weights(edge);
    for (std::size_t k = 0; k < details.row_indices(edge).size(); ++k)
      squared += static_cast<double>(weights[k]) * weights[k];
    scales[static_cast<Eigen::Index>(level.vertex_count + edge)] = 1.0 / std::sqrt(squared);
  }
  return scales;
}

}  // namespace zerotree::analysis
