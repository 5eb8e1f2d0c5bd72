#include "input_curves.h"

#include <algorithm>
#include <cmath>

namespace zerotree::test {
namespace {

std::array<std::uint32_t, 2> in_order(std::uint32_t a, std::uint32_t b) {
  return {std::min(a, b), std::max(a, b)};
}

}  // namespace

InputCurves::InputCurves(const relax::InputSurface& surface,
                         const std::vector<domain::VertexKind>& kinds)
    : surface_(surface) {
  const auto& faces = surface.topology.faces;
  for (std::uint32_t f = 0; f < faces.size(); ++f)
    for (int k = 0; k < 3; ++k) {
      if (!domain::is_feature(surface.topology, f, k)) continue;
      const Edge edge = in_order(faces[f][k], faces[f][domain::kNext[k]]);
      if (!edges_.try_emplace(edge, Place{SIZE_MAX, 0}, 0).second) continue;
      neighbours_[edge[0]].push_back(edge[1]);
      neighbours_[edge[1]].push_back(edge[0]);
    }
  for (const bool from_ends : {true, false})
    for (const auto& [vertex, next] : neighbours_) {
      if (from_ends && kinds[vertex] == domain::VertexKind::chain) continue;
      for (std::uint32_t n : next)
        if (edges_.at(in_order(vertex, n)).first.curve == SIZE_MAX) trace(vertex, n, kinds);
    }
}

void InputCurves::trace(std::uint32_t start, std::uint32_t next,
                        const std::vector<domain::VertexKind>& kinds) {
  const std::size_t curve = lengths_.size();
  double at = 0;
  for (std::uint32_t from = start;;) {
    const Edge edge = in_order(from, next);
    const double to = at + (surface_.mesh.positions[from] - surface_.mesh.positions[next]).norm();
    edges_.at(edge) = {{curve, edge[0] == from ? at : to}, edge[0] == from ? to : at};
    at = to;
    if (next == start || kinds[next] != domain::VertexKind::chain) break;
    const auto& ends = neighbours_.at(next);
    const std::uint32_t onward = ends[0] == from ? ends[1] : ends[0];
    from = next;
    next = onward;
  }
  lengths_.push_back(at);
  is_closed_.push_back(next == start);
  length_ += at;
}

std::vector<InputCurves::Place> InputCurves::places_of(const relax::SurfacePoint& point) const {
  std::vector<Place> places;
  const Triangle& face = surface_.topology.faces[point.face];
  if (point.edge >= 0) {
    const std::uint32_t a = face[static_cast<std::size_t>(point.edge)];
    const std::uint32_t b = face[static_cast<std::size_t>(domain::kNext[point.edge])];
    const auto& [lower, higher] = edges_.at(in_order(a, b));
    const double t = a < b ? point.weights[domain::kNext[point.edge]] : point.weights[point.edge];
    places.push_back({lower.curve, lower.at + t * (higher - lower.at)});
    return places;
  }
  int corner = 0;
  if (point.weights.maxCoeff(&corner) < 1 - 1e-9) return places;
  const std::uint32_t vertex = face[static_cast<std::size_t>(corner)];
  const auto found = neighbours_.find(vertex);
  if (found == neighbours_.end()) return places;
  for (std::uint32_t n : found->second) {
    const auto& [lower, higher] = edges_.at(in_order(vertex, n));
    places.push_back({lower.curve, vertex < n ? lower.at : higher});
  }
  return places;
}

std::optional<double> InputCurves::distance(const relax::SurfacePoint& a,
                                            const relax::SurfacePoint& b) const {
  std::optional<double> least;
  for (const Place& from : places_of(a))
    for (const Place& to : places_of(b)) {
      if (from.curve != to.curve) continue;
      double apart = std::abs(from.at - to.at);
      if (is_closed_[from.curve]) apart = std::min(apart, lengths_[from.curve] - apart);
      least = std::min(least.value_or(apart), apart);
    }
  return least;
}

}  // namespace zerotree::test
