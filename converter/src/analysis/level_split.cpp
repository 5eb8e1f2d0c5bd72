#include "analysis/level_split.h"

#include <array>
#include <cstddef>

#include "analysis/coordinate_solve.h"
#include "analysis/eliminated_matrix.h"
#include "analysis/synthesis_matrix.h"

namespace zerotree::analysis {

namespace {

using Coordinates = std::array<Eigen::VectorXd, 3>;

Coordinates coordinates_of(const Points& points) {
  Coordinates result;
  for (int axis = 0; axis < 3; ++axis) {
    Eigen::VectorXd& values = result[static_cast<std::size_t>(axis)];
    values.resize(static_cast<Eigen::Index>(points.size()));
    for (std::size_t i = 0; i < points.size(); ++i)
      values[static_cast<Eigen::Index>(i)] = points[i][axis];
  }
  return result;
}

Points points_of(const Coordinates& coordinates, std::size_t first, std::size_t count) {
  Points points;
  points.reserve(count);
  for (std::size_t i = first; i < first + count; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    points.emplace_back(coordinates[0][row], coordinates[1][row], coordinates[2][row]);
  }
  return points;
}

// P reproduces constants: centring costs nothing and makes the tolerance one of shape.
Points centred(const Points& points, const Eigen::Vector3d& centre) {
  Points result = points;
  for (Eigen::Vector3d& p : result) p -= centre;
  return result;
}

Eigen::Vector3d mean_of(const Points& points) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : points) sum += p;
  return sum / static_cast<double>(points.size());
}

// Adds each edge's value, times its weight there, at its end points.
Points add_at_ends(const surface::SubdivisionLevel& level,
                   const std::vector<std::array<float, 2>>& weights, const Eigen::Vector3d* edges,
                   Points points) {
  for (std::size_t edge = 0; edge < level.edge_count; ++edge)
    for (std::size_t end = 0; end < 2; ++end)
      points[level.edges.vertices[edge][end]] +=
          static_cast<double>(weights[edge][end]) * edges[edge];
  return points;
}

}  // namespace

CoarseAndDetails split_by_columns(const surface::SubdivisionLevel& level, const Points& fine,
                                  const SplitOptions& options) {
  SparseMatrix matrix = synthesis_matrix(level);
  const Eigen::VectorXd scales = column_scales(level);
  for (Eigen::Index entry = 0; entry < matrix.nonZeros(); ++entry)
    matrix.valuePtr()[entry] *= scales[matrix.innerIndexPtr()[entry]];
  const Eigen::Vector3d centre = mean_of(fine);
  const Coordinates right = coordinates_of(centred(fine, centre));
  // The even points without the details are a good first guess.
  Coordinates guess = right;
  for (Eigen::VectorXd& values : guess) {
    values = values.cwiseQuotient(scales).eval();
    values.tail(static_cast<Eigen::Index>(level.edge_count)).setZero();
  }
  Coordinates solution = solve_coordinates(matrix, right, guess, options);
  for (Eigen::VectorXd& values : solution) values = values.cwiseProduct(scales).eval();
  CoarseAndDetails result{points_of(solution, 0, level.vertex_count),
                          points_of(solution, level.vertex_count, level.edge_count)};
  for (Eigen::Vector3d& p : result.coarse) p += centre;
  return result;
}

CoarseAndDetails split_by_elimination(const surface::SubdivisionLevel& level, const Points& fine,
                                      const SplitOptions& options) {
  const Eigen::Vector3d centre = mean_of(fine);
  const Points shape = centred(fine, centre);
  const auto odd = shape.begin() + static_cast<std::ptrdiff_t>(level.vertex_count);
  const Points even(shape.begin(), odd);
  const Coordinates right =
      coordinates_of(add_at_ends(level, level.local_details.dips, &*odd, even));
  const SparseMatrix matrix = eliminated_matrix(level);
  const Coordinates solution = solve_coordinates(matrix, right, coordinates_of(even), options);
  const Points lowered = points_of(solution, 0, level.vertex_count);
  CoarseAndDetails result;
  result.details.assign(odd, shape.end());
  for (std::size_t edge = 0; edge < level.edge_count; ++edge)
    for_each_tap(level.subdivision, level.vertex_count + edge,
                 [&](std::size_t vertex, double weight) {
                   result.details[edge] -= weight * lowered[vertex];
                 });
  result.coarse = add_at_ends(level, level.local_details.lifts, result.details.data(), lowered);
  for (Eigen::Vector3d& p : result.coarse) p += centre;
  return result;
}

Points subdivide(const surface::SubdivisionLevel& level, const Points& coarse) {
  const auto& rows = level.subdivision;
  Points fine(rows.sizes.size(), Eigen::Vector3d::Zero());
  for (std::size_t row = 0; row < fine.size(); ++row)
    for_each_tap(rows, row,
                 [&](std::size_t vertex, double weight) { fine[row] += weight * coarse[vertex]; });
  return fine;
}

}  // namespace zerotree::analysis
