#include "analysis/local_details.h"

#include <cstddef>
#include <utility>

#include "surface/edge_frames.h"
#include "surface/surface_synthesis.h"

namespace zerotree::analysis {

namespace {

std::vector<float> single_precision(const std::vector<Eigen::Vector3d>& vectors) {
  std::vector<float> result;
  result.reserve(3 * vectors.size());
  for (const Eigen::Vector3d& v : vectors)
    for (int axis = 0; axis < 3; ++axis) result.push_back(static_cast<float>(v[axis]));
  return result;
}

}  // namespace

std::vector<std::vector<Eigen::Vector3d>> local_details(
    const surface::SubdivisionHierarchy& hierarchy, const WaveletDecomposition& decomposition) {
  std::vector<std::vector<Eigen::Vector3d>> result = decomposition.details;
  surface::Positions points = single_precision(decomposition.base_control_points);
  for (std::size_t number = 0; number < result.size(); ++number) {
    const surface::SubdivisionLevel& level = hierarchy.level(static_cast<int>(number));
    surface::Positions fine = surface::subdivide(level, points);
    for (std::size_t edge = 0; edge < level.edge_count; ++edge) {
      const surface::EdgeTangents tangents = surface::edge_tangents(
          fine.data(), level.vertex_count, level.edges.vertices[edge], level.edges.wings[edge]);
      Eigen::Vector3d& detail = result[number][edge];
      const auto [normal, tangent1, tangent2] =
          tangents.frame().components({detail.x(), detail.y(), detail.z()});
      detail = {normal, tangent1, tangent2};
    }
    surface::add_details(level, single_precision(decomposition.details[number]), fine);
    points = std::move(fine);
  }
  return result;
}

}  // namespace zerotree::analysis
