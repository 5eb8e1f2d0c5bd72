#include "analysis/coordinate_solve.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <Eigen/IterativeLinearSolvers>
#include <algorithm>
#include <cstddef>
#include <string>

#include "mesh/error.h"

namespace zerotree::analysis {

namespace {

Eigen::VectorXd solve(const SparseMatrix& matrix, const Eigen::VectorXd& right,
                      const Eigen::VectorXd& guess, const SplitOptions& options) {
  Eigen::BiCGSTAB<SparseMatrix, Eigen::DiagonalPreconditioner<double>> solver(matrix);
  solver.setTolerance(options.tolerance);
  solver.setMaxIterations(options.most_iterations);
  Eigen::VectorXd solution = solver.solveWithGuess(right, guess);
  if (solver.info() != Eigen::Success || !solution.allFinite())
    throw Error(ExitCode::internal,
                "the wavelet analysis did not converge: residual " +
                    std::to_string(solver.error()) + " after " +
                    std::to_string(solver.iterations()) +
                    " iterations; a base mesh without vertices of valence 3 and 4 helps");
  return solution;
}

}  // namespace

std::array<Eigen::VectorXd, 3> solve_coordinates(const SparseMatrix& matrix,
                                                 const std::array<Eigen::VectorXd, 3>& right,
                                                 const std::array<Eigen::VectorXd, 3>& guess,
                                                 const SplitOptions& options) {
  std::array<Eigen::VectorXd, 3> solution;
  tbb::task_arena(std::clamp(options.threads, 1, 3)).execute([&] {
    tbb::parallel_for(std::size_t{0}, std::size_t{3}, [&](std::size_t axis) {
      solution[axis] = solve(matrix, right[axis], guess[axis], options);
    });
  });
  return solution;
}

}  // namespace zerotree::analysis
