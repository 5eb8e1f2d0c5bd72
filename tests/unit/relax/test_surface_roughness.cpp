// Where the input bends, and that the remesh gathers there.
#include "relax/surface_roughness.h"

#include <gtest/gtest.h>

#include <cmath>

#include "relax/surface_relaxation.h"
#include "shapes.h"

namespace zerotree::test {
namespace {

using Eigen::Vector3d;

/// A sheet of 8 by 4 that is flat for x < 4 and has waves beyond.
TriangleMesh half_rough_sheet() {
  TriangleMesh mesh = midpoint_subdivide(grid(8, 4), 3);
  for (Vector3d& p : mesh.positions)
    if (p.x() > 4) p.z() = 0.1 * std::sin(6 * (p.x() - 4)) * std::sin(6 * p.y());
  return mesh;
}

std::vector<float> roughness_of(const TriangleMesh& mesh) {
  const domain::TriangleTopology topology =
      domain::build_topology(static_cast<std::uint32_t>(mesh.positions.size()), mesh.triangles);
  return relax::relative_roughness({mesh, topology});
}

TEST(SurfaceRoughness, IsLargeWhereTheSurfaceBends) {
  const TriangleMesh mesh = half_rough_sheet();
  const std::vector<float> roughness = roughness_of(mesh);
  for (std::size_t v = 0; v < roughness.size(); ++v) {
    if (mesh.positions[v].x() < 2) {
      EXPECT_LT(roughness[v], 0.1f);
    }
    if (mesh.positions[v].x() > 5) {
      EXPECT_GT(roughness[v], 1.0f);
    }
  }
}

TEST(SurfaceRoughness, DoesNotDependOnTheUnit) {
  TriangleMesh mesh = half_rough_sheet();
  const std::vector<float> before = roughness_of(mesh);
  for (Vector3d& p : mesh.positions) p *= 1000;
  const std::vector<float> after = roughness_of(mesh);
  for (std::size_t v = 0; v < before.size(); ++v) EXPECT_NEAR(after[v], before[v], 1e-4);
}

TEST(SurfaceRoughness, IsOneOnFlatSheets) {
  for (const float roughness : roughness_of(grid(5, 5))) EXPECT_EQ(roughness, 1.0f);
}

TEST(SurfaceRoughness, GathersVertices) {
  const domain::Domain domain = domain::build_domain(half_rough_sheet(), {12, 0, {}}, {});
  const remesh::Parameterisation laid_out = remesh::remesh(domain, {.levels = 4}, {}).laid_out;
  const relax::RelaxedMesh relaxed = relax::relax(domain, laid_out, 4, {.steps = 20}, {});
  double flat = 0, rough = 0;  // vertices per area of the sheet's halves
  for (const Vector3d& p : relaxed.mesh.positions) (p.x() < 4 ? flat : rough) += 1;
  EXPECT_GT(rough, 1.15 * flat);
}

}  // namespace
}  // namespace zerotree::test
