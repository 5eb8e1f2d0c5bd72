#include "fit/smoothness_penalty.h"

#include <algorithm>

namespace zerotree::fit {
namespace {

constexpr std::uint32_t kNone = 0xffffffffu;

// Of each edge its faces; `k` tells which edge of the face it is.
struct EdgeFaces {
  std::array<std::uint32_t, 2> faces{kNone, kNone};
  std::array<std::uint8_t, 2> edge_in_face{0, 0};
};

std::vector<EdgeFaces> faces_of_edges(const relax::SubdividedLevel& level) {
  std::vector<EdgeFaces> all(level.edges.size());
  for (std::uint32_t f = 0; f < level.triangles.size(); ++f)
    for (std::uint8_t k = 0; k < 3; ++k) {
      EdgeFaces& edge = all[level.face_edges[f][k]];
      const std::size_t side = edge.faces[0] == kNone ? 0 : 1;
      edge.faces[side] = f;
      edge.edge_in_face[side] = k;
    }
  return all;
}

// Of each vertex on a curve its two neighbours along it; none where curves end, meet or turn.
std::vector<std::array<std::uint32_t, 2>> curve_neighbours(const bitstream::BaseTopology& base,
                                                           const relax::SubdividedLevel& level) {
  std::vector<std::array<std::uint32_t, 2>> neighbours(level.vertex_count, {kNone, kNone});
  std::vector<std::uint8_t> count(level.vertex_count, 0);
  const auto add = [&](std::uint32_t at, std::uint32_t to) {
    if (count[at] < 2) neighbours[at][count[at]] = to;
    ++count[at];
  };
  for (std::size_t e = 0; e < level.edges.size(); ++e) {
    if (!level.is_feature[e]) continue;
    add(level.edges[e][0], level.edges[e][1]);
    add(level.edges[e][1], level.edges[e][0]);
  }
  for (std::size_t v = 0; v < neighbours.size(); ++v)
    if (count[v] != 2) neighbours[v] = {kNone, kNone};
  for (std::uint32_t v : base.corner_vertices) neighbours[v] = {kNone, kNone};
  return neighbours;
}

}  // namespace

SmoothnessPenalty::SmoothnessPenalty(const bitstream::BaseTopology& base,
                                     const relax::SubdividedLevel& coarse, const Points& normals,
                                     const Points& positions, const SmoothnessWeights& weights)
    : first_odd_(coarse.vertex_count), stencils_(coarse.edges.size()) {
  set_axes(coarse, normals, positions, weights);
  const std::vector<EdgeFaces> edge_faces = faces_of_edges(coarse);
  const std::vector<std::array<std::uint32_t, 2>> curve = curve_neighbours(base, coarse);
  for (std::uint32_t e = 0; e < stencils_.size(); ++e) {
    Stencil& stencil = stencils_[e];
    const auto add = [&](std::uint32_t vertex, float weight) {
      for (std::uint32_t i = 0; i < stencil.count; ++i)
        if (stencil.vertices[i] == vertex) {
          stencil.weights[i] += weight;
          return;
        }
      stencil.vertices[stencil.count] = vertex;
      stencil.weights[stencil.count++] = weight;
    };
    const auto [a, b] = coarse.edges[e];
    if (coarse.is_feature[e]) {
      if (curve[a][0] == kNone || curve[b][0] == kNone) continue;
      add(a, 9.0f / 16);
      add(b, 9.0f / 16);
      add(curve[a][0] == b ? curve[a][1] : curve[a][0], -1.0f / 16);
      add(curve[b][0] == a ? curve[b][1] : curve[b][0], -1.0f / 16);
      continue;
    }
    add(a, 0.5f);
    add(b, 0.5f);
    for (std::size_t side = 0; side < 2; ++side) {
      const std::uint32_t face = edge_faces[e].faces[side];
      const std::size_t k = edge_faces[e].edge_in_face[side];
      const Triangle& t = coarse.triangles[face];
      const std::uint32_t apex = t[(k + 2) % 3];
      add(apex, 0.125f);
      for (std::size_t step : {1, 2}) {
        const std::size_t rim = (k + step) % 3;
        const std::uint32_t rim_edge = coarse.face_edges[face][rim];
        const EdgeFaces& beyond = edge_faces[rim_edge];
        if (coarse.is_feature[rim_edge]) {
          add(t[rim], -1.0f / 16);
          add(t[(rim + 1) % 3], -1.0f / 16);
          add(t[(rim + 2) % 3], 1.0f / 16);
        } else {
          const std::size_t other = beyond.faces[0] == face ? 1 : 0;
          const Triangle& wing = coarse.triangles[beyond.faces[other]];
          add(wing[(beyond.edge_in_face[other] + 2u) % 3], -1.0f / 16);
        }
      }
    }
  }
}

void SmoothnessPenalty::set_axes(const relax::SubdividedLevel& coarse, const Points& normals,
                                 const Points& positions, const SmoothnessWeights& weights) {
  for (std::size_t e = 0; e < stencils_.size(); ++e) {
    const auto [a, b] = coarse.edges[e];
    const bool on_curve = coarse.is_feature[e] != 0;
    const Eigen::Vector3d axis =
        on_curve ? (positions[b] - positions[a]).eval() : normals[first_odd_ + e];
    stencils_[e].axis = axis.stableNormalized().cast<float>();
    stencils_[e].along_axis = static_cast<float>(on_curve ? weights.tangential : weights.normal);
    stencils_[e].across_axis = static_cast<float>(on_curve ? weights.normal : weights.tangential);
  }
}

template <class Vector>
void SmoothnessPenalty::add_gradient(double sign, const std::vector<Vector>& points,
                                     std::vector<Vector>& gradient) const {
  using Scalar = typename Vector::Scalar;
  for (std::size_t e = 0; e < stencils_.size(); ++e) {
    const Stencil& stencil = stencils_[e];
    if (stencil.count == 0) continue;
    Vector difference = points[first_odd_ + e];
    for (std::uint32_t i = 0; i < stencil.count; ++i)
      difference -= Scalar{stencil.weights[i]} * points[stencil.vertices[i]];
    const Vector axis = stencil.axis.template cast<Scalar>();
    const Scalar across = stencil.across_axis, along = Scalar{stencil.along_axis} - across;
    difference =
        static_cast<Scalar>(sign) * (across * difference + along * axis.dot(difference) * axis);
    gradient[first_odd_ + e] += difference;
    for (std::uint32_t i = 0; i < stencil.count; ++i)
      gradient[stencil.vertices[i]] -= Scalar{stencil.weights[i]} * difference;
  }
}

template void SmoothnessPenalty::add_gradient(double, const Points&, Points&) const;
template void SmoothnessPenalty::add_gradient(double, const Differences&, Differences&) const;

void SmoothnessPenalty::add_diagonal(std::vector<double>& diagonal) const {
  for (std::size_t e = 0; e < stencils_.size(); ++e) {
    const Stencil& stencil = stencils_[e];
    if (stencil.count == 0) continue;
    const double weight = static_cast<double>(std::max(stencil.along_axis, stencil.across_axis));
    diagonal[first_odd_ + e] += weight;
    for (std::uint32_t i = 0; i < stencil.count; ++i) {
      const auto w = static_cast<double>(stencil.weights[i]);
      diagonal[stencil.vertices[i]] += weight * w * w;
    }
  }
}

}  // namespace zerotree::fit
