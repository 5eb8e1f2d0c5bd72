#include "surface/detail_weights.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "surface/edge_frames.h"

namespace zerotree::surface {

namespace {

Vector3 difference(std::span<const float> positions, std::uint32_t to, std::uint32_t from) {
  Vector3 result{};
  for (std::size_t axis = 0; axis < 3; ++axis)
    result[axis] = static_cast<double>(positions[3 * std::size_t{to} + axis]) -
                   static_cast<double>(positions[3 * std::size_t{from} + axis]);
  return result;
}

}  // namespace

double mean_face_area(const bitstream::BaseTopology& topology, std::span<const float> positions) {
  double total = 0.0;
  for (const auto& [a, b, c] : topology.triangles) {
    const Vector3 normal = cross_product(difference(positions, b, a), difference(positions, c, a));
    total += 0.5 * std::sqrt(dot_product(normal, normal));
  }
  return total / static_cast<double>(std::max<std::size_t>(topology.triangles.size(), 1));
}

float area_weight(double area, double mean_area) {
  const double weight = std::sqrt((1.0 - kMeanAreaShare) * area / mean_area + kMeanAreaShare);
  return std::isnan(weight) ? 1.0f : static_cast<float>(std::min(weight, kLargestAreaWeight));
}

Vector3 detail_move(const EdgeTangents& tangents, const Vector3& detail, double mean_area) {
  const EdgeFrame frame = tangents.frame();
  const double scale = 1.0 / static_cast<double>(area_weight(tangents.triangle_area(), mean_area));
  Vector3 move;
  for (std::size_t axis = 0; axis < 3; ++axis)
    move[axis] = scale * (frame.normal[axis] * detail[0] + frame.tangent1[axis] * detail[1] +
                          frame.tangent2[axis] * detail[2]);
  return move;
}

float detail_unit(const Dequantisation& dequantisation, int levels, int level,
                  bitstream::Channel channel) {
  const float step = channel == bitstream::kNormal
                         ? dequantisation.step
                         : dequantisation.step * dequantisation.tangent_ratio;
  return step / basis_norm(levels - 1 - level);
}

}  // namespace zerotree::surface
