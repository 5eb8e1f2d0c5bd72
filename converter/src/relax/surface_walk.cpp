#include "relax/surface_walk.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace zerotree::relax {
namespace {

using domain::kNext;
using domain::kNone;
using domain::kPrev;

// A step crosses a few faces; more than this means that it goes round in a fan.
constexpr int kMostFaces = 1000;
// Weights this close to zero lie on the edge.
constexpr double kOnEdge = 1e-9;

// A face as the walk sees it: its edges from corner 0.
struct FacePlane {
  FacePlane(const InputSurface& surface, std::uint32_t face)
      : e1(surface.corner(face, 1) - surface.corner(face, 0)),
        e2(surface.corner(face, 2) - surface.corner(face, 0)) {}

  // The change of the weights along the part of a vector in the plane; not finite if the face has
  // no area.
  Eigen::Vector3d weights_along(const Eigen::Vector3d& direction) const {
    const double a = e1.squaredNorm(), b = e1.dot(e2), c = e2.squaredNorm();
    const double d1 = direction.dot(e1), d2 = direction.dot(e2), determinant = a * c - b * b;
    const double w1 = (c * d1 - b * d2) / determinant, w2 = (a * d2 - b * d1) / determinant;
    return {-w1 - w2, w1, w2};
  }
  // ... and back: the vector that changes the weights so.
  Eigen::Vector3d vector_of(const Eigen::Vector3d& change) const {
    return change[1] * e1 + change[2] * e2;
  }

  Eigen::Vector3d e1, e2;
};

// Carries a vector of the plane of `face` over its edge `k` into the plane of the next face.
Eigen::Vector3d unfold(const InputSurface& surface, std::uint32_t face, int k, std::uint32_t next,
                       int next_apex, const Eigen::Vector3d& direction) {
  const Eigen::Vector3d start = surface.corner(face, k);
  const Eigen::Vector3d along = unit(surface.corner(face, kNext[k]) - start);
  const double forward = direction.dot(along);
  const double outward = (direction - forward * along).norm();
  const Eigen::Vector3d apex = surface.corner(next, next_apex) - start;
  const Eigen::Vector3d inward = unit(apex - apex.dot(along) * along);
  return forward * along + outward * inward;
}

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

SurfacePoint walk_on_surface(const InputSurface& surface, const SurfacePoint& start,
                             const Eigen::Vector3d& displacement) {
  SurfacePoint point = start;
  point.edge = -1;
  Eigen::Vector3d rest = displacement;
  int entry = -1;  // the edge the walk came in by
  for (int step = 0; step < kMostFaces; ++step) {
    const FacePlane plane(surface, point.face);
    const Eigen::Vector3d change = plane.weights_along(rest);
    if (!change.allFinite()) return point;
    double share = 1;
    int exit = -1;
    for (int k = 0; k < 3; ++k) {
      const int opposite = kPrev[k];  // the corner that edge k does not touch
      if (k == entry || change[opposite] >= 0) continue;
      const double reach = -point.weights[opposite] / change[opposite];
      if (reach < share) {
        share = std::max(reach, 0.0);
        exit = k;
      }
    }
    point.weights += share * change;
    if (exit >= 0) point.weights[kPrev[exit]] = 0;
    clamp_weights(point.weights);
    if (exit < 0 || domain::is_feature(surface.topology, point.face, exit)) return point;

    const std::uint32_t next = surface.topology.adjacent[point.face][exit];
    const int back = domain::edge_towards(surface.topology, next, point.face);
    rest =
        unfold(surface, point.face, exit, next, kPrev[back], (1 - share) * plane.vector_of(change));
    Eigen::Vector3d weights = Eigen::Vector3d::Zero();
    weights[back] = point.weights[kNext[exit]];
    weights[kNext[back]] = point.weights[exit];
    point.face = next;
    point.weights = weights;
    entry = back;
  }
  return point;
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
