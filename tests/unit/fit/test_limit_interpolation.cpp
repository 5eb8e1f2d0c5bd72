// Control points whose limit surface passes through the samples.
#include "fit/limit_interpolation.h"

#include <gtest/gtest.h>

#include "mesh/error.h"
#include "mesh/triangle_mesh.h"
#include "shapes.h"
#include "surface/surface_synthesis.h"

namespace zerotree::test {
namespace {

bitstream::BaseTopology topology_of(const Shape& shape) {
  return {static_cast<std::uint32_t>(shape.mesh.positions.size()), shape.mesh.triangles,
          shape.crease_edges, shape.corner_vertices};
}

/// Largest distance of a limit position from its sample.
double largest_miss(const surface::SubdivisionHierarchy& hierarchy,
                    const std::vector<Eigen::Vector3d>& control,
                    const std::vector<Eigen::Vector3d>& samples) {
  surface::Positions points, limit(3 * control.size());
  for (const Eigen::Vector3d& p : control)
    for (int axis = 0; axis < 3; ++axis) points.push_back(static_cast<float>(p[axis]));
  surface::limit_surface(hierarchy.level(hierarchy.levels()), points, {limit.data()}, {});
  double largest = 0.0;
  for (std::size_t v = 0; v < samples.size(); ++v)
    largest = std::max(
        largest,
        (Eigen::Vector3d(limit[3 * v], limit[3 * v + 1], limit[3 * v + 2]) - samples[v]).norm());
  return largest;
}

// The samples of these flat faces with kinks are as rough as can be: few steps help, many do it.
TEST(LimitInterpolation, MeetsTheSamplesOnEachShape) {
  for (const Shape& shape : base_shapes()) {
    const surface::SubdivisionHierarchy hierarchy(
        topology_of(shape), 2, surface::WaveletTransform::loop_quadrature_mirror);
    std::vector<Eigen::Vector3d> samples = shape.mesh.positions;
    for (int number = 0; number < 2; ++number)
      for (const auto& [tail, head] : hierarchy.level(number).edges.vertices)
        samples.push_back(0.5 * (samples[tail] + samples[head]));
    const double before = largest_miss(hierarchy, samples, samples);
    const auto few = fit::control_points_from_samples(hierarchy, samples, {});
    EXPECT_LT(largest_miss(hierarchy, few, samples), 0.7 * before + 1e-6) << shape.name;
    const auto many = fit::control_points_from_samples(hierarchy, samples, {120});
    EXPECT_LT(largest_miss(hierarchy, many, samples), 1e-6) << shape.name;
  }
}

TEST(LimitInterpolation, KeepsASphereFromShrinking) {
  const TriangleMesh mesh = sphere(3);
  const bitstream::BaseTopology base{
      static_cast<std::uint32_t>(mesh.positions.size()), mesh.triangles, {}, {}};
  const surface::SubdivisionHierarchy hierarchy(base, 0,
                                                surface::WaveletTransform::loop_quadrature_mirror);
  const double before = largest_miss(hierarchy, mesh.positions, mesh.positions);
  EXPECT_GT(before, 2e-3);
  const auto control = fit::control_points_from_samples(base, 0, mesh.positions, {});
  EXPECT_LT(largest_miss(hierarchy, control, mesh.positions), 0.15 * before);
}

TEST(LimitInterpolation, RefusesAWrongNumberOfSamples) {
  const TriangleMesh mesh = icosahedron();
  const bitstream::BaseTopology base{12, mesh.triangles, {}, {}};
  EXPECT_THROW(fit::control_points_from_samples(base, 1, mesh.positions, {}), Error);
}

}  // namespace
}  // namespace zerotree::test
