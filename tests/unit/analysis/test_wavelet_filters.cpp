// Q against P: orthogonality and condition.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "analysis/synthesis_matrix.h"
#include "surface/surface_synthesis.h"
#include "torus_base.h"

namespace zerotree::test {
namespace {

using surface::SubdivisionHierarchy;

/// [P Q] of `level`, found by asking the runtime where each coarse point and each detail goes.
Eigen::MatrixXd dense_synthesis(const surface::SubdivisionLevel& level) {
  const std::size_t coarse = level.vertex_count, edges = level.edge_count;
  Eigen::MatrixXd matrix(static_cast<Eigen::Index>(coarse + edges),
                         static_cast<Eigen::Index>(coarse + edges));
  for (std::size_t column = 0; column < coarse + edges; ++column) {
    surface::Positions points(3 * coarse, 0.0f);
    surface::Moves moves(3 * edges, 0.0f);
    (column < coarse ? points[3 * column] : moves[3 * (column - coarse)]) = 1.0f;
    surface::Positions fine = surface::subdivide(level, points);
    surface::add_details(level, moves, fine);
    for (std::size_t row = 0; row < coarse + edges; ++row)
      matrix(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column)) = fine[3 * row];
  }
  return matrix;
}

/// [P Q] with columns of comparable length: 1/2 for P, 1/|Q| for each of Q.
Eigen::MatrixXd scaled_synthesis(const surface::SubdivisionLevel& level) {
  Eigen::MatrixXd matrix = dense_synthesis(level);
  matrix.leftCols(level.vertex_count) *= 0.5;
  matrix.rightCols(level.edge_count).colwise().normalize();
  return matrix;
}

/// The whole transform from the base and the details of all levels to the finest control points,
/// with the columns scaled.
Eigen::MatrixXd scaled_transform(const SubdivisionHierarchy& hierarchy) {
  Eigen::MatrixXd transform;
  for (int number = 0; number < hierarchy.levels(); ++number) {
    const auto& level = hierarchy.level(number);
    Eigen::MatrixXd step = scaled_synthesis(level);
    if (number > 0)
      step.leftCols(level.vertex_count) = step.leftCols(level.vertex_count) * transform;
    transform = std::move(step);
  }
  return transform;
}

double condition_number(const Eigen::MatrixXd& matrix) {
  // Singular values from the normal matrix: half the digits are plenty here.
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(matrix.transpose() * matrix,
                                                              Eigen::EigenvaluesOnly);
  return std::sqrt(solver.eigenvalues().maxCoeff() / solver.eigenvalues().minCoeff());
}

TEST(WaveletFilterColumns, AreTheMatrixThatTheAnalysisSolves) {
  for (const Shape& shape : base_shapes()) {
    const SubdivisionHierarchy hierarchy(topology_of(shape), 1, kQuadratureMirror);
    const auto& level = hierarchy.level(0);
    Eigen::MatrixXd matrix = analysis::synthesis_matrix(level);
    EXPECT_LT((matrix - dense_synthesis(level)).cwiseAbs().maxCoeff(), 1e-6) << shape.name;
    matrix = matrix * analysis::column_scales(level).asDiagonal();
    EXPECT_LT((matrix - scaled_synthesis(level)).cwiseAbs().maxCoeff(), 1e-6) << shape.name;
  }
}

TEST(WaveletFilterColumns, AreOrthogonalOnTheRegularTorus) {
  constexpr std::uint32_t kSize = 5;
  const SubdivisionHierarchy hierarchy(regular_torus(kSize), 1, kQuadratureMirror);
  const auto& level = hierarchy.level(0);
  const Eigen::MatrixXd matrix = analysis::synthesis_matrix(level);
  const Eigen::MatrixXd p = matrix.leftCols(level.vertex_count);
  const Eigen::MatrixXd q = matrix.rightCols(level.edge_count);
  EXPECT_LT((p.transpose() * q).cwiseAbs().maxCoeff(), 1e-6);
  // Subbands of different edge orientation are orthogonal too; within one, neighbours are not.
  const auto orientation = [&](int edge) {
    const auto& [tail, head] = level.edges.vertices[static_cast<std::size_t>(edge)];
    const bool same_row = tail / kSize == head / kSize, same_column = tail % kSize == head % kSize;
    return same_row ? 0 : same_column ? 1 : 2;
  };
  const Eigen::MatrixXd products = q.transpose() * q;
  for (int i = 0; i < q.cols(); ++i) {
    EXPECT_NEAR(products(i, i), 346.0 / 256.0, 1e-6);
    for (int j = 0; j < q.cols(); ++j) {
      if (orientation(i) != orientation(j)) {
        EXPECT_NEAR(products(i, j), 0.0, 1e-6);
      }
    }
  }
}

TEST(WaveletFilterColumns, HaveVanishingMean) {
  for (const Shape& shape : base_shapes()) {
    const SubdivisionHierarchy hierarchy(topology_of(shape), 2, kQuadratureMirror);
    for (int number = 0; number < 2; ++number) {
      const auto& level = hierarchy.level(number);
      const Eigen::MatrixXd matrix = analysis::synthesis_matrix(level);
      EXPECT_LT(matrix.rightCols(level.edge_count).colwise().sum().cwiseAbs().maxCoeff(), 1e-5)
          << shape.name;
    }
  }
}

// The local filter gives up orthogonality for small support, but not much of it: the cosine between
// a detail and the coarse points, whose own cosines with each other reach 1/2.
TEST(WaveletFilterColumns, AreNearlyOrthogonalOnTheRegularTorusWhereLocal) {
  const SubdivisionHierarchy hierarchy(regular_torus(5), 1, kLocal);
  const auto& level = hierarchy.level(0);
  Eigen::MatrixXd matrix = dense_synthesis(level);
  EXPECT_LT(matrix.rightCols(level.edge_count).colwise().sum().cwiseAbs().maxCoeff(), 1e-6);
  matrix.colwise().normalize();
  const Eigen::MatrixXd cosines =
      matrix.leftCols(level.vertex_count).transpose() * matrix.rightCols(level.edge_count);
  EXPECT_LT(cosines.cwiseAbs().maxCoeff(), 0.07);
}

// Irregular vertices leave some of it, each level half as much; curves much more, for what lies
// beside them must not move them.
TEST(WaveletFilterColumns, HaveASmallMeanOnClosedSurfacesWhereLocal) {
  for (const Shape& shape : base_shapes()) {
    if (shape.name == "grid" || shape.name == "two_components" || shape.name == "cube") continue;
    const SubdivisionHierarchy hierarchy(topology_of(shape), 2, kLocal);
    for (int number = 0; number < 2; ++number) {
      const auto& level = hierarchy.level(number);
      const Eigen::MatrixXd details = dense_synthesis(level).rightCols(level.edge_count);
      const double bound = shape.name == "tetrahedron" ? 0.71 : 0.35;
      EXPECT_LT(details.colwise().sum().cwiseAbs().maxCoeff(), std::ldexp(bound, -number))
          << shape.name;
    }
  }
}

class WaveletFilters : public testing::TestWithParam<surface::WaveletTransform> {};

TEST_P(WaveletFilters, AreWellConditionedOnTheRegularTorus) {
  const SubdivisionHierarchy hierarchy(regular_torus(3), 2, GetParam());
  EXPECT_LT(condition_number(scaled_transform(hierarchy)), GetParam() == kLocal ? 9.0 : 20.0);
}

TEST_P(WaveletFilters, AreWellConditionedOnEachShape) {
  // Valences 3 and 4 condition badly; with them the bound is the measured one.
  const double ordinary = GetParam() == kLocal ? 12.0 : 25.0;
  const double any = GetParam() == kLocal ? 16.0 : 50.0;
  for (const Shape& shape : base_shapes()) {
    if (shape.mesh.positions.size() > 20) continue;  // a dense eigenvalue problem
    const SubdivisionHierarchy hierarchy(topology_of(shape), 2, GetParam());
    const bool is_ordinary = shape.name == "icosahedron" || shape.name == "grid";
    EXPECT_LT(condition_number(scaled_transform(hierarchy)), is_ordinary ? ordinary : any)
        << shape.name;
  }
}

INSTANTIATE_TEST_SUITE_P(Transforms, WaveletFilters, testing::ValuesIn(kTransforms),
                         [](const auto& test) { return name_of(test.param); });

}  // namespace
}  // namespace zerotree::test
