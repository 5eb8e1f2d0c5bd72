#include "discretisation/discretisation_error.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <filesystem>

#include "clean/clean_mesh.h"
#include "discretisation/butterfly_subdivision.h"
#include "import/import_mesh.h"
#include "measure/surface_distance.h"
#include "shapes.h"

namespace zerotree::discretisation {
namespace {

double relative_error(const TriangleMesh& mesh) {
  const measure::SurfaceIndex index(mesh, 1);
  return discretisation_error(mesh, index, {}) / bounding_box_diagonal(mesh.positions);
}

// What it stands for: two steps of subdivision, measured both ways.
double subdivided_error(const TriangleMesh& mesh) {
  const FeaturedMesh fine = butterfly_subdivide(butterfly_subdivide(find_features(mesh, 0)));
  return measure::compare_surfaces(mesh, fine.mesh, {.samples = 100'000, .threads = 2})
      .relative_rms();
}

TEST(DiscretisationError, FallsWithTheSquareOfTheEdge) {
  const double coarse = relative_error(test::sphere(3)), fine = relative_error(test::sphere(4));
  EXPECT_NEAR(coarse / fine, 4.0, 0.2);
}

// A triangle of edge h lies h^2 / 8 below a unit sphere, on average.
TEST(DiscretisationError, OfASphereIsThatOfItsTriangles) {
  const TriangleMesh sphere = test::sphere(4);
  const measure::SurfaceIndex index(sphere, 1);
  double squared_edge = 0;
  for (const Triangle& t : sphere.triangles)
    for (int k = 0; k < 3; ++k)
      squared_edge += (sphere.positions[t[k]] - sphere.positions[t[(k + 1) % 3]]).squaredNorm();
  const double below = squared_edge / (3.0 * static_cast<double>(sphere.triangles.size())) / 8;
  EXPECT_NEAR(discretisation_error(sphere, index, {}), below, 0.15 * below);
}

TEST(DiscretisationError, IsNothingWhereNothingBends) {
  EXPECT_LT(relative_error(test::midpoint_subdivide(test::voxel_surface({{0, 0, 0}}), 3)), 1e-9);
  EXPECT_LT(relative_error(test::grid(8, 8)), 1e-9);
}

TEST(DiscretisationError, IsNearThatOfTwoSubdivisions) {
  for (const TriangleMesh& mesh :
       {test::add_bumps(test::sphere(3), 0.02, 2.0), test::add_noise(test::sphere(3), 0.1, 5),
        test::add_bumps(test::midpoint_subdivide(test::grid(6, 5), 2), 0.03, 2.0)}) {
    const double expected = subdivided_error(mesh);
    EXPECT_NEAR(relative_error(mesh), expected, 0.1 * expected);
  }
}

TEST(DiscretisationError, IsTheSameOnAnyNumberOfThreads) {
  const TriangleMesh mesh = test::add_bumps(test::sphere(4), 0.02, 2.0);
  const double many = relative_error(mesh);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(relative_error(mesh), many);
}

struct KnownModel {
  const char* file;
  double error;  // E_d of the paper's table 1
};

// The paper does not say how often it subdivides nor what it does with creases, but the figures are
// of that size. Skipped where the folder of test meshes is missing.
TEST(DiscretisationError, IsOfTheSizeThatThePaperTells) {
  for (const KnownModel& model : {KnownModel{"feline.off", 7.3e-5},
                                  {"bunny.off", 9.4e-5},
                                  {"horse.ply", 6.0e-5},
                                  {"venus.off", 5.5e-5}}) {
    const std::filesystem::path path =
        std::filesystem::path(SHARED_DATA_FOLDER) / "paper5" / model.file;
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "no test meshes in " << SHARED_DATA_FOLDER;
    SCOPED_TRACE(model.file);
    const TriangleMesh mesh =
        clean::clean_mesh(importer::import_mesh(path, {}, {}).mesh, {}, {}).mesh;
    const double error = relative_error(mesh);
    EXPECT_GT(error, 0.5 * model.error);
    EXPECT_LT(error, 2.0 * model.error);
  }
}

}  // namespace
}  // namespace zerotree::discretisation
