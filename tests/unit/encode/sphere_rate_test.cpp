// The paper's smallest example: a smooth semi-regular sphere of 2562 vertices, 0.5e-4 in 166 bytes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "analysis/wavelet_analysis.h"
#include "bitstream/base_traversal.h"
#include "bitstream/stream_decoder.h"
#include "encode/encode.h"
#include "shapes.h"
#include "surface/surface_synthesis.h"

namespace zerotree {
namespace {

constexpr int kLevels = 4;

surface::Positions flat(const std::vector<Eigen::Vector3d>& points) {
  surface::Positions result;
  for (const Eigen::Vector3d& p : points) {
    for (int axis = 0; axis < 3; ++axis) result.push_back(static_cast<float>(p[axis]));
  }
  return result;
}

std::vector<Eigen::Vector3d> limit_points(const surface::SubdivisionLevel& level,
                                          const surface::Positions& control_points) {
  std::vector<float> limit(control_points.size());
  surface::limit_surface(level, control_points, {limit.data()}, {});
  std::vector<Eigen::Vector3d> points(limit.size() / 3);
  for (std::size_t v = 0; v < points.size(); ++v) {
    for (int axis = 0; axis < 3; ++axis) points[v][axis] = double{limit[3 * v + axis]};
  }
  return points;
}

// Control points whose limit points are the smooth icosahedral Loop surface blown up to a sphere.
std::vector<Eigen::Vector3d> sphere_control_points(const surface::SubdivisionHierarchy& hierarchy,
                                                   surface::Positions base) {
  for (int level = 0; level < kLevels; ++level) {
    base = surface::subdivide(hierarchy.level(level), base);
  }
  const surface::SubdivisionLevel& finest = hierarchy.level(kLevels);
  std::vector<Eigen::Vector3d> sphere = limit_points(finest, base);
  for (Eigen::Vector3d& p : sphere) p.normalize();
  std::vector<Eigen::Vector3d> control = sphere;
  for (int step = 0; step < 15; ++step) {
    const std::vector<Eigen::Vector3d> limit = limit_points(finest, flat(control));
    for (std::size_t v = 0; v < control.size(); ++v) control[v] += sphere[v] - limit[v];
  }
  return control;
}

// Root mean square of the limit points' distance from the sphere, relative to the diagonal.
double sphere_error(const bitstream::StreamDecoder& decoder,
                    const surface::SubdivisionHierarchy& hierarchy, double diagonal) {
  const surface::Dequantisation dequantisation{{}, decoder.header().finest_step, 4.0f};
  const surface::Positions control = surface::reconstruct(
      hierarchy, decoder.base_positions(), decoder.coefficients(), dequantisation, kLevels);
  double sum = 0.0;
  const auto points = limit_points(hierarchy.level(kLevels), control);
  for (const Eigen::Vector3d& p : points) sum += (p.norm() - 1.0) * (p.norm() - 1.0);
  return std::sqrt(sum / static_cast<double>(points.size())) / diagonal;
}

TEST(SphereRate, ReachesThePapersErrorInItsBytes) {
  const TriangleMesh icosahedron = test::icosahedron();
  const bitstream::BaseTopology shape{12, icosahedron.triangles, {}, {}};
  const bitstream::BaseOrder order = bitstream::canonical_base_order(shape);
  const bitstream::BaseTopology base = bitstream::reorder(shape, order);
  std::vector<Eigen::Vector3d> corners;
  for (const std::uint32_t old : order.vertices) corners.push_back(icosahedron.positions[old]);
  const surface::SubdivisionHierarchy hierarchy(base, kLevels, {});
  const std::vector<Eigen::Vector3d> control = sphere_control_points(hierarchy, flat(corners));
  ASSERT_EQ(control.size(), 2562u);

  const auto decomposition = analysis::analyse(hierarchy, control, {}, {});
  encode::EncodeOptions options;
  options.finest_step = 5e-4;
  const encode::EncodedStream stream = encode::encode(base, decomposition, options);
  const double diagonal = bounding_box_diagonal(icosahedron.positions);
  const auto error_at = [&](std::size_t bytes) {
    bitstream::StreamDecoder decoder;
    decoder.feed(std::span(stream.bytes).first(std::min(bytes, stream.bytes.size())));
    EXPECT_TRUE(decoder.base_ready());
    return sphere_error(decoder, hierarchy, diagonal);
  };
  EXPECT_LT(error_at(166), 0.25e-4);
  EXPECT_LT(error_at(130), 0.5e-4);
}

}  // namespace
}  // namespace zerotree
