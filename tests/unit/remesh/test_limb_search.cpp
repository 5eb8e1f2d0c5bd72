// Limbs that a base has lost are found and kept.
#include "remesh/limb_search.h"

#include <gtest/gtest.h>

#include <limits>

#include "shapes.h"

namespace zerotree::remesh {
namespace {

// A sphere with two long thin horns.
TriangleMesh horned_sphere() {
  TriangleMesh mesh = test::sphere(5);
  for (Eigen::Vector3d& p : mesh.positions) {
    const double tip = std::abs(p.z()) - 0.97;
    if (tip > 0) p.z() += std::copysign(60 * tip, p.z());
  }
  return mesh;
}

domain::CoarseDomain coarse_horns() {
  domain::DomainOptions options;
  options.base_vertices = 14;
  options.crease_angle_degrees = 180;
  const domain::Domain domain = domain::build_domain(horned_sphere(), options, {});
  return domain::extract_coarse(domain, domain.collapses.size() - 400);
}

TEST(LimbSearch, SeesWhereTheSurfaceIsSqueezed) {
  const domain::CoarseDomain coarse = coarse_horns();
  const Parameterisation laid_out = parameterise(coarse.domain, {});
  ASSERT_EQ(laid_out.stuck, 0u);
  const SpreadReport spread = measure_spread(coarse.domain, laid_out, 2);
  EXPECT_GT(spread.energy, 1);
  EXPECT_LE(spread.squeezed.size(), 2u);
  for (std::uint32_t v : spread.squeezed)
    EXPECT_GT(std::abs(coarse.domain.mesh.positions[v].z()), 0.9);
}

TEST(LimbSearch, PinsOnlyWhatHelps) {
  domain::CoarseDomain coarse = coarse_horns();
  const auto energy_of = [](const domain::Domain& domain) {
    return measure_spread(domain, parameterise(domain, {}), 1).energy;
  };
  const double before = energy_of(coarse.domain);
  const std::vector<std::uint32_t> pinned =
      pin_limbs(coarse.domain, std::numeric_limits<std::size_t>::max(), {});
  EXPECT_LE(energy_of(coarse.domain), before);
  for (const domain::CollapseRecord& collapse : coarse.domain.collapses)
    EXPECT_FALSE(std::ranges::binary_search(pinned, collapse.removed));
}

TEST(LimbSearch, LeavesABaseThatIsTooLargeAlone) {
  domain::CoarseDomain coarse = coarse_horns();
  const std::vector<std::uint32_t> base = coarse.domain.base_faces;
  EXPECT_TRUE(pin_limbs(coarse.domain, base.size() - 1, {}).empty());
  EXPECT_EQ(coarse.domain.base_faces, base);
}

}  // namespace
}  // namespace zerotree::remesh
