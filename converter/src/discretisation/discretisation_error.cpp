#include "discretisation/discretisation_error.h"

#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "discretisation/butterfly_subdivision.h"
#include "measure/surface_samples.h"

namespace zerotree::discretisation {
namespace {

using Eigen::Vector3d;

// Fixed, so that sums do not depend on the number of threads.
constexpr std::size_t kChunk = 1024;

Vector3d barycentric(const Vector3d& p, const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const Vector3d normal = (b - a).cross(c - a);
  const double area = normal.squaredNorm();
  if (area <= 0) return Vector3d::Constant(1.0 / 3);
  const double v = (p - a).cross(c - a).dot(normal) / area;
  const double w = (b - a).cross(p - a).dot(normal) / area;
  return {1 - v - w, v, w};
}

// The quadratic surface through the corners of `face` and the points of its edges.
Vector3d patch_point(const FeaturedMesh& mesh, const std::array<Vector3d, 3>& edges,
                     const measure::SurfaceSample& sample) {
  const Triangle& t = mesh.mesh.triangles[sample.triangle];
  const auto corner = [&](int k) -> const Vector3d& { return mesh.mesh.positions[t[k]]; };
  const Vector3d at = barycentric(sample.position, corner(0), corner(1), corner(2));
  Vector3d p = Vector3d::Zero();
  for (int k = 0; k < 3; ++k)
    p += at[k] * (2 * at[k] - 1) * corner(k) + 4 * at[k] * at[domain::kNext[k]] * edges[k];
  return p;
}

// Sum of squared distances of the patches from the surface at the samples first..last-1.
double squared_distances(const FeaturedMesh& mesh, const measure::SurfaceSamples& samples,
                         std::size_t first, std::size_t last,
                         const measure::SurfaceIndex& surface) {
  ButterflyStencils stencils(mesh);
  double sum = 0;
  std::uint32_t face = measure::SurfacePoint::no_triangle, hint = face;
  std::array<Vector3d, 3> edges;
  for (const measure::SurfaceSample& sample : samples.range(first, last)) {
    if (sample.triangle != face) {
      face = sample.triangle;
      for (int k = 0; k < 3; ++k) edges[k] = stencils.edge_point(face, k);
    }
    const measure::SurfacePoint nearest = surface.closest(patch_point(mesh, edges, sample), hint);
    hint = nearest.triangle;
    sum += nearest.distance_squared;
  }
  return sum;
}

}  // namespace

double discretisation_error(const TriangleMesh& mesh, const measure::SurfaceIndex& surface,
                            const DiscretisationOptions& options) {
  const FeaturedMesh featured = find_features(mesh, options.crease_angle_degrees);
  const measure::SurfaceSamples samples(featured.mesh, options.samples);
  std::vector<double> sums((options.samples + kChunk - 1) / kChunk, 0.0);
  tbb::parallel_for(std::size_t{0}, sums.size(), [&](std::size_t chunk) {
    const std::size_t first = chunk * kChunk;
    sums[chunk] = squared_distances(featured, samples, first,
                                    std::min(first + kChunk, options.samples), surface);
  });
  double sum = 0;
  for (double s : sums) sum += s;
  return std::sqrt(sum / static_cast<double>(options.samples));
}

}  // namespace zerotree::discretisation
