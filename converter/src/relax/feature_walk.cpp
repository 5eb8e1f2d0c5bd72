#include "relax/surface_walk.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace zerotree::relax {
namespace {

using domain::kNext;
using domain::kPrev;

// A step crosses a few faces; more than this means that it goes round in a fan.
constexpr int kMostFaces = 1000;
// Weights this close to zero lie on the edge.
constexpr double kOnEdge = 1e-9;

void clamp_weights(Eigen::Vector3d& weights) {
  weights = weights.cwiseMax(0.0);
  weights /= weights.sum();
}

// The end of edge `k` of `face` that is corner kNext[k] (forward) or k, as a vertex.
std::uint32_t edge_end(const InputSurface& surface, std::uint32_t face, int k, bool forward) {
  return surface.topology.faces[face][forward ? kNext[k] : k];
}

// Goes on from the end of a feature edge to the next one, through the faces on this side. The sense
// stays: forward along a face's order leads to an edge that goes forward in its face.
bool next_feature_edge(const InputSurface& surface, bool forward, std::uint32_t& face, int& edge) {
  const std::uint32_t vertex = edge_end(surface, face, edge, forward);
  for (int step = 0; step < kMostFaces; ++step) {
    const int corner = domain::corner_of(surface.topology.faces[face], vertex);
    edge = forward ? corner : kPrev[corner];
    if (domain::is_feature(surface.topology, face, edge)) return true;
    face = surface.topology.adjacent[face][edge];
  }
  return false;
}

}  // namespace

Eigen::Vector3d InputSurface::face_normal(std::uint32_t face) const {
  return (corner(face, 1) - corner(face, 0)).cross(corner(face, 2) - corner(face, 0));
}

SurfacePoint walk_along_feature(const InputSurface& surface,
                                const std::vector<domain::VertexKind>& kinds,
                                const SurfacePoint& start, const Eigen::Vector3d& displacement) {
  std::uint32_t face = start.face;
  int edge = start.edge;
  double t = start.weights[kNext[edge]];
  const Eigen::Vector3d first = surface.corner(face, kNext[edge]) - surface.corner(face, edge);
  double rest = displacement.dot(unit(first));
  const bool forward = rest >= 0;
  rest = std::abs(rest);
  for (int step = 0; step < kMostFaces; ++step) {
    const double length = (surface.corner(face, kNext[edge]) - surface.corner(face, edge)).norm();
    const double left = (forward ? 1 - t : t) * length;
    if (rest < left) {
      t += (forward ? rest : -rest) / length;
      break;
    }
    if (kinds[edge_end(surface, face, edge, forward)] != domain::VertexKind::chain) {
      t = forward ? t + 0.5 * (1 - t) : 0.5 * t;
      break;
    }
    rest -= left;
    if (!next_feature_edge(surface, forward, face, edge)) return start;
    t = forward ? 0.0 : 1.0;
  }
  SurfacePoint point;
  point.face = face;
  point.edge = edge;
  point.weights[edge] = 1 - t;
  point.weights[kNext[edge]] = t;
  return point;
}

bool snap_to_feature(const InputSurface& surface, SurfacePoint& point) {
  int best = -1;
  for (int k = 0; k < 3; ++k)
    if (domain::is_feature(surface.topology, point.face, k) &&
        (best < 0 || point.weights[kPrev[k]] < point.weights[kPrev[best]]))
      best = k;
  if (best >= 0 && point.weights[kPrev[best]] <= kOnEdge * 1e3) {
    point.edge = best;
    point.weights[kPrev[best]] = 0;
    clamp_weights(point.weights);
    return true;
  }
  // At a vertex of the mesh: any feature edge of its fan.
  int corner = 0;
  point.weights.maxCoeff(&corner);
  if (point.weights[corner] < 1 - kOnEdge * 1e3) return false;
  domain::Star star;
  domain::gather_star(surface.topology, surface.topology.faces[point.face][corner], star);
  for (const domain::Corner& at : star.corners)
    for (int k : {at.corner, kPrev[at.corner]}) {
      if (!domain::is_feature(surface.topology, at.face, k)) continue;
      point.face = at.face;
      point.edge = k;
      point.weights = Eigen::Vector3d::Zero();
      point.weights[at.corner] = 1;
      return true;
    }
  return false;
}

}  // namespace zerotree::relax
