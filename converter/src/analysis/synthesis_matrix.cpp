#include "analysis/synthesis_matrix.h"

#include <cmath>
#include <vector>

namespace zerotree::analysis {

SparseMatrix synthesis_matrix(const surface::SubdivisionLevel& level) {
  using Entry = Eigen::Triplet<double, int>;
  const auto& subdivision = level.subdivision;
  const auto& details = level.details;
  std::vector<Entry> entries;
  entries.reserve(subdivision.indices.size() + details.indices.size());
  for (std::size_t row = 0; row < subdivision.sizes.size(); ++row) {
    const auto begin = static_cast<std::size_t>(subdivision.offsets[row]);
    const auto end = begin + static_cast<std::size_t>(subdivision.sizes[row]);
    for (std::size_t k = begin; k < end; ++k)
      entries.emplace_back(static_cast<int>(row), subdivision.indices[k], subdivision.weights[k]);
  }
  for (std::size_t edge = 0; edge < details.row_count(); ++edge) {
    const float* weight = details.row_weights(edge);
    for (const std::uint32_t vertex : details.row_indices(edge))
      entries.emplace_back(static_cast<int>(vertex), static_cast<int>(level.vertex_count + edge),
                           *weight++);
  }
  const auto size = static_cast<Eigen::Index>(subdivision.sizes.size());
  SparseMatrix matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
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
