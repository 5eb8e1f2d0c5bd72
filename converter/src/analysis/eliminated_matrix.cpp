#include "analysis/eliminated_matrix.h"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

namespace zerotree::analysis {

namespace {

// Gathers the rows one vertex at a time.
class RowGatherer {
 public:
  explicit RowGatherer(const surface::SubdivisionLevel& level)
      : level_(level), place_(level.vertex_count, -1), edges_begin_(level.vertex_count + 1, 0) {
    for (const auto& ends : level.edges.vertices)
      for (const std::uint32_t v : ends) ++edges_begin_[v + 1];
    for (std::size_t v = 0; v < level.vertex_count; ++v) edges_begin_[v + 1] += edges_begin_[v];
    edge_ends_.resize(edges_begin_.back());
    std::vector<std::size_t> next(edges_begin_.begin(), edges_begin_.end() - 1);
    for (std::size_t edge = 0; edge < level.edge_count; ++edge)
      for (std::size_t end = 0; end < 2; ++end)
        edge_ends_[next[level.edges.vertices[edge][end]]++] = 2 * edge + end;
  }

  SparseMatrix build() {
    const auto size = static_cast<Eigen::Index>(level_.vertex_count);
    SparseMatrix matrix(size, size);
    // The ring of every vertex and itself.
    matrix.reserve(size + 2 * static_cast<Eigen::Index>(level_.edge_count));
    for (std::size_t v = 0; v < level_.vertex_count; ++v) {
      gather_row(v);
      matrix.startVec(static_cast<Eigen::Index>(v));
      std::sort(row_.begin(), row_.end());
      for (const auto& [column, weight] : row_) {
        matrix.insertBack(static_cast<Eigen::Index>(v), static_cast<Eigen::Index>(column)) = weight;
        place_[column] = -1;
      }
    }
    matrix.finalize();
    return matrix;
  }

 private:
  void gather_row(std::size_t v) {
    row_.clear();
    const auto add = [&](std::size_t column, double weight) {
      if (place_[column] < 0) {
        place_[column] = static_cast<int>(row_.size());
        row_.emplace_back(column, 0.0);
      }
      row_[static_cast<std::size_t>(place_[column])].second += weight;
    };
    for_each_tap(level_.subdivision, v, add);
    for (std::size_t i = edges_begin_[v]; i < edges_begin_[v + 1]; ++i) {
      const std::size_t edge = edge_ends_[i] / 2;
      const double dip = level_.local_details.dips[edge][edge_ends_[i] % 2];
      if (dip == 0) continue;
      for_each_tap(level_.subdivision, level_.vertex_count + edge,
                   [&](std::size_t column, double weight) { add(column, dip * weight); });
    }
  }

  const surface::SubdivisionLevel& level_;
  std::vector<int> place_;  // of a column in the row being gathered
  std::vector<std::pair<std::size_t, double>> row_;
  std::vector<std::size_t> edges_begin_, edge_ends_;  // 2 * edge + end, by vertex
};

}  // namespace

SparseMatrix eliminated_matrix(const surface::SubdivisionLevel& level) {
  return RowGatherer(level).build();
}

}  // namespace zerotree::analysis
