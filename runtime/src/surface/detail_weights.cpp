#include "surface/detail_weights.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace zerotree::surface {

namespace {

/// Measured on the regular lattice: the norm of Q's column carried on by P.
constexpr std::array<float, 7> kQuadratureMirrorNorms = {1.0f,  1.20f, 2.16f, 4.22f,
                                                         8.39f, 16.7f, 33.5f};
constexpr float kSmallestWeight = 0.125f;
constexpr float kLargestWeight = 8.0f;

double face_area(const bitstream::BaseTopology& topology, std::uint32_t face,
                 std::span<const float> positions) {
  const auto& corners = topology.triangles[face];
  std::array<double, 3> u{}, v{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double origin = positions[3 * std::size_t{corners[0]} + axis];
    u[axis] = positions[3 * std::size_t{corners[1]} + axis] - origin;
    v[axis] = positions[3 * std::size_t{corners[2]} + axis] - origin;
  }
  const double x = u[1] * v[2] - u[2] * v[1];
  const double y = u[2] * v[0] - u[0] * v[2];
  const double z = u[0] * v[1] - u[1] * v[0];
  return 0.5 * std::sqrt(x * x + y * y + z * z);
}

}  // namespace

float basis_norm(WaveletTransform /*transform*/, int levels_above_finest) {
  const int last = static_cast<int>(kQuadratureMirrorNorms.size()) - 1;
  const int level = std::max(levels_above_finest, 0);
  const float tabulated = kQuadratureMirrorNorms[static_cast<std::size_t>(std::min(level, last))];
  return level <= last ? tabulated : std::ldexp(tabulated, level - last);
}

std::vector<float> base_edge_weights(const bitstream::BaseTopology& topology,
                                     const std::vector<bitstream::BaseEdge>& base_edges,
                                     std::span<const float> base_positions) {
  const std::size_t face_count = topology.triangles.size();
  std::vector<double> areas(face_count);
  double total = 0.0;
  for (std::size_t face = 0; face < face_count; ++face) {
    areas[face] = face_area(topology, static_cast<std::uint32_t>(face), base_positions);
    total += areas[face];
  }
  const double mean = total / static_cast<double>(std::max<std::size_t>(face_count, 1));
  std::vector<float> weights(base_edges.size(), 1.0f);
  if (!(mean > 0.0) || !std::isfinite(mean)) return weights;
  for (std::size_t edge = 0; edge < base_edges.size(); ++edge) {
    const auto& faces = base_edges[edge].faces;
    double area = areas[faces[0]];
    if (faces[1] != bitstream::kNone) area = 0.5 * (area + areas[faces[1]]);
    weights[edge] =
        std::clamp(static_cast<float>(std::sqrt(area / mean)), kSmallestWeight, kLargestWeight);
  }
  return weights;
}

float detail_unit(const Dequantisation& dequantisation, int levels, int level,
                  bitstream::Channel channel, float edge_weight) {
  const float step = channel == bitstream::kNormal
                         ? dequantisation.step
                         : dequantisation.step * dequantisation.tangent_ratio;
  return step / (basis_norm(dequantisation.transform, levels - 1 - level) * edge_weight);
}

}  // namespace zerotree::surface
