#include "analysis/wavelet_analysis.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <Eigen/IterativeLinearSolvers>
#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "analysis/synthesis_matrix.h"
#include "mesh/error.h"
#include "surface/edge_frames.h"

namespace zerotree::analysis {

namespace {

using Points = std::vector<Eigen::Vector3d>;

void check_points(const surface::SubdivisionHierarchy& hierarchy, const Points& points) {
  const std::size_t expected = hierarchy.level(hierarchy.levels()).vertex_count;
  if (points.size() != expected)
    throw Error(ExitCode::internal, "wavelet analysis got " + std::to_string(points.size()) +
                                        " control points for a level of " +
                                        std::to_string(expected) + " vertices");
  for (std::size_t vertex = 0; vertex < points.size(); ++vertex)
    if (!points[vertex].allFinite())
      throw Error(ExitCode::internal,
                  "control point " + std::to_string(vertex) + " of the remesh is not finite");
}

/// One coordinate of a level: x of [P Q] x = fine.
Eigen::VectorXd solve_coordinate(const SparseMatrix& scaled, const Eigen::VectorXd& scales,
                                 const Eigen::VectorXd& fine, const AnalysisOptions& options) {
  Eigen::BiCGSTAB<SparseMatrix, Eigen::DiagonalPreconditioner<double>> solver(scaled);
  solver.setTolerance(options.tolerance);
  solver.setMaxIterations(options.most_iterations);
  // The even points without the details are a good first guess.
  Eigen::VectorXd guess = fine.cwiseQuotient(scales);
  guess.tail(scaled.cols()).setZero();
  const Eigen::VectorXd solution = solver.solveWithGuess(fine, guess);
  if (solver.info() != Eigen::Success || !solution.allFinite())
    throw Error(ExitCode::internal,
                "the wavelet analysis did not converge: residual " +
                    std::to_string(solver.error()) + " after " +
                    std::to_string(solver.iterations()) +
                    " iterations; a base mesh without vertices of valence 3 and 4 helps");
  return solution.cwiseProduct(scales);
}

struct CoarseAndDetails {
  Points coarse, details;
};

CoarseAndDetails split_level(const surface::SubdivisionLevel& level, const Points& fine,
                             const AnalysisOptions& options) {
  SparseMatrix matrix = synthesis_matrix(level);
  const Eigen::VectorXd scales = column_scales(level);
  for (Eigen::Index entry = 0; entry < matrix.nonZeros(); ++entry)
    matrix.valuePtr()[entry] *= scales[matrix.innerIndexPtr()[entry]];
  const Eigen::Map<const Eigen::Matrix3Xd> fine_points(fine.data()->data(), 3,
                                                       static_cast<Eigen::Index>(fine.size()));
  // P reproduces constants: centring costs nothing and makes the tolerance one of shape.
  const Eigen::Vector3d centre = fine_points.rowwise().mean();
  std::array<Eigen::VectorXd, 3> solution;
  tbb::task_arena(std::clamp(options.threads, 1, 3)).execute([&] {
    tbb::parallel_for(0, 3, [&](int axis) {
      const Eigen::VectorXd right = (fine_points.row(axis).array() - centre[axis]).transpose();
      solution[static_cast<std::size_t>(axis)] = solve_coordinate(matrix, scales, right, options);
    });
  });
  const auto at = [&](std::size_t column) {
    const auto row = static_cast<Eigen::Index>(column);
    return Eigen::Vector3d(solution[0][row], solution[1][row], solution[2][row]);
  };
  CoarseAndDetails result;
  for (std::size_t vertex = 0; vertex < level.vertex_count; ++vertex)
    result.coarse.push_back(at(vertex) + centre);
  for (std::size_t edge = 0; edge < level.edge_count; ++edge)
    result.details.push_back(at(level.vertex_count + edge));
  return result;
}

Points subdivide(const surface::SubdivisionLevel& level, const Points& coarse) {
  const auto& rows = level.subdivision;
  Points fine(rows.sizes.size(), Eigen::Vector3d::Zero());
  for (std::size_t row = 0; row < fine.size(); ++row)
    for (int k = rows.offsets[row]; k < rows.offsets[row] + rows.sizes[row]; ++k) {
      const auto entry = static_cast<std::size_t>(k);
      fine[row] += static_cast<double>(rows.weights[entry]) *
                   coarse[static_cast<std::size_t>(rows.indices[entry])];
    }
  return fine;
}

/// Turns details from global axes into (normal, tangent 1, tangent 2).
void express_in_frames(const surface::SubdivisionLevel& level, const Points& coarse,
                       Points& details) {
  const Points predicted = subdivide(level, coarse);
  const auto vector = [](const surface::Vector3& v) { return Eigen::Vector3d(v[0], v[1], v[2]); };
  for (std::size_t edge = 0; edge < details.size(); ++edge) {
    const surface::EdgeFrame frame =
        surface::edge_frame(predicted.data()->data(), level.vertex_count,
                            level.edges.vertices[edge], level.edges.wings[edge]);
    details[edge] = Eigen::Vector3d(vector(frame.normal).dot(details[edge]),
                                    vector(frame.tangent1).dot(details[edge]),
                                    vector(frame.tangent2).dot(details[edge]));
  }
}

}  // namespace

WaveletDecomposition analyse(const surface::SubdivisionHierarchy& hierarchy,
                             const Points& finest_control_points, const AnalysisOptions& options,
                             const Progress& progress) {
  check_points(hierarchy, finest_control_points);
  const int levels = hierarchy.levels();
  const auto finest_count = static_cast<double>(finest_control_points.size());
  WaveletDecomposition decomposition;
  decomposition.details.resize(static_cast<std::size_t>(levels));
  Points points = finest_control_points;
  for (int number = levels - 1; number >= 0; --number) {
    report_progress(progress, "wavelet analysis",
                    1.0 - static_cast<double>(points.size()) / finest_count);
    const surface::SubdivisionLevel& level = hierarchy.level(number);
    CoarseAndDetails split = split_level(level, points, options);
    express_in_frames(level, split.coarse, split.details);
    decomposition.details[static_cast<std::size_t>(number)] = std::move(split.details);
    points = std::move(split.coarse);
  }
  decomposition.base_control_points = std::move(points);
  report_progress(progress, "wavelet analysis", 1.0);
  return decomposition;
}

WaveletDecomposition analyse(const bitstream::BaseTopology& base, int levels,
                             const Points& finest_control_points, const AnalysisOptions& options,
                             const Progress& progress) {
  return analyse(surface::SubdivisionHierarchy(base, levels, options.transform),
                 finest_control_points, options, progress);
}

}  // namespace zerotree::analysis
