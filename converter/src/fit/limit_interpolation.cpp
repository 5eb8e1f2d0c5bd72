#include "fit/limit_interpolation.h"

#include <cstddef>
#include <cstdint>
#include <string>

#include "mesh/error.h"

namespace zerotree::fit {

namespace {

Eigen::Vector3d limit_position(const surface::SharedStencils& limit, std::size_t vertex,
                               const std::vector<Eigen::Vector3d>& points) {
  // The first of the three planes of weights is the position's.
  const float* weight = limit.row_weights(vertex);
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  for (const std::uint32_t neighbour : limit.row_indices(vertex))
    position += static_cast<double>(*weight++) * points[neighbour];
  return position;
}

}  // namespace

std::vector<Eigen::Vector3d> control_points_from_samples(
    const surface::SubdivisionHierarchy& hierarchy, const std::vector<Eigen::Vector3d>& samples,
    const InterpolationOptions& options) {
  const surface::SubdivisionLevel& finest = hierarchy.level(hierarchy.levels());
  if (samples.size() != finest.vertex_count)
    throw Error(ExitCode::internal, "the fit got " + std::to_string(samples.size()) +
                                        " samples for a level of " +
                                        std::to_string(finest.vertex_count) + " vertices");
  std::vector<Eigen::Vector3d> points = samples, next(samples.size());
  for (int iteration = 0; iteration < options.iterations; ++iteration) {
    for (std::size_t vertex = 0; vertex < points.size(); ++vertex)
      next[vertex] =
          points[vertex] + samples[vertex] - limit_position(finest.limit, vertex, points);
    points.swap(next);
  }
  return points;
}

std::vector<Eigen::Vector3d> control_points_from_samples(
    const bitstream::BaseTopology& base, int levels, const std::vector<Eigen::Vector3d>& samples,
    const InterpolationOptions& options) {
  const surface::SubdivisionHierarchy hierarchy(base, levels,
                                                surface::WaveletTransform::loop_quadrature_mirror);
  return control_points_from_samples(hierarchy, samples, options);
}

}  // namespace zerotree::fit
