#include "measure/surface_distance.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "measure/surface_samples.h"
#include "mesh/error.h"

namespace zerotree::measure {
namespace {

// Work is cut into chunks of this size whatever the number of threads, and the chunks' sums are
// added in order: that makes the result independent of the threads.
constexpr std::size_t chunk_size = 2048;

struct Sums {
  double distance = 0.0;
  double squared = 0.0;
  double max_squared = 0.0;
  double angle = 0.0;
  double max_angle = 0.0;

  void add(const Sums& other) {
    distance += other.distance;
    squared += other.squared;
    max_squared = std::max(max_squared, other.max_squared);
    angle += other.angle;
    max_angle = std::max(max_angle, other.max_angle);
  }
};

Eigen::Vector3d area_vector(const TriangleMesh& mesh, std::uint32_t triangle) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  const Eigen::Vector3d& p = mesh.positions[a];
  return (mesh.positions[b] - p).cross(mesh.positions[c] - p);
}

// atan2 of sine and cosine is accurate for small angles, where an arc cosine is not.
double angle_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

Sums measure_samples(const SurfaceSamples& samples, std::size_t first, std::size_t last,
                     const TriangleMesh& sampled, const SurfaceIndex& surface) {
  Sums sums;
  std::uint32_t hint = SurfacePoint::no_triangle;
  for (const SurfaceSample& sample : samples.range(first, last)) {
    const SurfacePoint nearest = surface.closest(sample.position, hint);
    hint = nearest.triangle;
    const double angle = angle_between(area_vector(sampled, sample.triangle),
                                       area_vector(surface.mesh(), nearest.triangle));
    sums.add({std::sqrt(nearest.distance_squared), nearest.distance_squared,
              nearest.distance_squared, angle, angle});
  }
  return sums;
}

Sums measure_vertices(const std::vector<std::uint32_t>& vertices, std::size_t first,
                      std::size_t last, const TriangleMesh& sampled, const SurfaceIndex& surface) {
  Sums sums;
  std::uint32_t hint = SurfacePoint::no_triangle;
  for (std::size_t i = first; i < last; ++i) {
    const SurfacePoint nearest = surface.closest(sampled.positions[vertices[i]], hint);
    hint = nearest.triangle;
    sums.max_squared = std::max(sums.max_squared, nearest.distance_squared);
  }
  return sums;
}

// The vertices of the surface in the order in which the triangles of positive area first use them,
// so that neighbours in the list are neighbours in space.
std::vector<std::uint32_t> surface_vertices(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> vertices;
  vertices.reserve(mesh.positions.size());
  std::vector<bool> seen(mesh.positions.size(), false);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    if (!(area_vector(mesh, t).squaredNorm() > 0.0)) continue;
    for (std::uint32_t v : mesh.triangles[t]) {
      if (!seen[v]) vertices.push_back(v);
      seen[v] = true;
    }
  }
  return vertices;
}

// Calls measure(first, last) for the chunks of 0..count-1 in parallel; adds up in order.
template <class Measure>
Sums sum_over_chunks(std::size_t count, const Measure& measure) {
  std::vector<Sums> chunks((count + chunk_size - 1) / chunk_size);
  tbb::parallel_for(std::size_t{0}, chunks.size(), [&](std::size_t k) {
    chunks[k] = measure(k * chunk_size, std::min(count, (k + 1) * chunk_size));
  });
  Sums sums;
  for (const Sums& chunk : chunks) sums.add(chunk);
  return sums;
}

DirectedDistance directed_distance(const TriangleMesh& sampled, const SurfaceIndex& surface,
                                   std::size_t sample_count) {
  const SurfaceSamples samples(sampled, sample_count);
  const Sums inside = sum_over_chunks(samples.size(), [&](std::size_t first, std::size_t last) {
    return measure_samples(samples, first, last, sampled, surface);
  });
  const std::vector<std::uint32_t> vertices = surface_vertices(sampled);
  const Sums corners = sum_over_chunks(vertices.size(), [&](std::size_t first, std::size_t last) {
    return measure_vertices(vertices, first, last, sampled, surface);
  });
  const double count = static_cast<double>(sample_count);
  constexpr double degrees = 180.0 / std::numbers::pi;
  return {std::sqrt(inside.squared / count), inside.distance / count,
          std::sqrt(std::max(inside.max_squared, corners.max_squared)),
          inside.angle / count * degrees, inside.max_angle * degrees};
}

DirectedDistance larger(const DirectedDistance& a, const DirectedDistance& b) {
  return {std::max(a.rms, b.rms), std::max(a.mean, b.mean), std::max(a.maximum, b.maximum),
          std::max(a.normal_mean_degrees, b.normal_mean_degrees),
          std::max(a.normal_max_degrees, b.normal_max_degrees)};
}

void check(const DistanceOptions& options) {
  if (options.samples == 0)
    throw Error(ExitCode::usage, "cannot measure with 0 samples: ask for at least one");
  if (options.threads < 0)
    throw Error(ExitCode::usage, "the number of threads must be 0 (all) or more");
}

}  // namespace

SurfaceDistance compare_surfaces(const SurfaceIndex& reference, const TriangleMesh& test,
                                 const DistanceOptions& options) {
  check(options);
  tbb::task_arena arena(options.threads > 0 ? options.threads : tbb::task_arena::automatic);
  return arena.execute([&] {
    const SurfaceIndex test_index(test, options.threads);
    SurfaceDistance distance;
    distance.from_reference = directed_distance(reference.mesh(), test_index, options.samples);
    distance.from_test = directed_distance(test, reference, options.samples);
    distance.symmetric = larger(distance.from_reference, distance.from_test);
    distance.diagonal = bounding_box_diagonal(reference.mesh().positions);
    return distance;
  });
}

SurfaceDistance compare_surfaces(const TriangleMesh& reference, const TriangleMesh& test,
                                 const DistanceOptions& options) {
  check(options);
  return compare_surfaces(SurfaceIndex(reference, options.threads), test, options);
}

}  // namespace zerotree::measure
