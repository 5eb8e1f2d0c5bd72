#include <Eigen/Geometry>
#include <array>
#include <cmath>

#include "relax/surface_walk.h"

namespace zerotree::relax {
namespace {

using domain::kNext;
using domain::kNone;
using domain::kPrev;
using Eigen::Vector2d;
using Eigen::Vector3d;

// A step crosses a few faces; more than this means that it goes round in a fan.
constexpr int kMostFaces = 1000;

double cross(const Vector2d& a, const Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

// The faces along a straight way, unfolded one after the other into the plane of the first: there
// the way is a segment, and each face costs the place of its one new corner.
class UnfoldedWay {
 public:
  UnfoldedWay(const InputSurface& surface, const SurfacePoint& start, const Vector3d& displacement)
      : surface_(surface), face_(start.face) {
    const Vector3d e1 = surface.corner(face_, 1) - surface.corner(face_, 0);
    const Vector3d e2 = surface.corner(face_, 2) - surface.corner(face_, 0);
    const double length = e1.norm();
    const Vector3d along = e1 / length;
    const double x = e2.dot(along);
    const Vector3d upright = e2 - x * along;
    const double height = upright.norm();
    corners_ = {Vector2d(0, 0), Vector2d(length, 0), Vector2d(x, height)};
    origin_ = start.weights[1] * corners_[1] + start.weights[2] * corners_[2];
    way_ = {displacement.dot(along), displacement.dot(upright) / height};
    has_area_ = way_.allFinite();
  }

  // False if the first face has no area, and so no directions.
  bool has_area() const { return has_area_; }

  // Through which edge of the first face the way leaves it; -1: it ends inside.
  int first_exit() const {
    double first = 1;
    int exit = -1;
    for (int k = 0; k < 3; ++k) {
      const double at_start = height_over(k, origin_), at_end = height_over(k, origin_ + way_);
      if (at_end >= 0 || at_end >= at_start) continue;
      const double inside = std::max(at_start, 0.0), share = inside / (inside - at_end);
      if (share >= first) continue;
      first = share;
      exit = k;
    }
    return exit;
  }

  // Goes over edge `exit`. Returns the edge to go on over; -1: the way ends in the new face.
  int cross_edge(int exit) {
    const std::uint32_t next = surface_.topology.adjacent[face_][exit];
    const int back = domain::edge_towards(surface_.topology, next, face_), apex = kPrev[back];
    const Vector2d a = corners_[exit], b = corners_[kNext[exit]];
    const Vector3d start = surface_.corner(face_, exit);
    const Vector3d edge = surface_.corner(face_, kNext[exit]) - start;
    const Vector3d side = surface_.corner(next, apex) - start;
    const double squared_length = edge.squaredNorm();
    if (!(squared_length > 0)) return -1;
    const double along = side.dot(edge) / squared_length;
    const double height = std::sqrt((side - along * edge).squaredNorm() / squared_length);
    const Vector2d flat = b - a;
    face_ = next;
    corners_[back] = b;
    corners_[kNext[back]] = a;
    corners_[apex] = a + along * flat + height * Vector2d(flat.y(), -flat.x());
    // The way passes the new corner on one side; there it leaves, if it does not end before.
    const int onward = cross(way_, corners_[apex] - origin_) > 0 ? kNext[back] : apex;
    return height_over(onward, origin_ + way_) < 0 ? onward : -1;
  }

  bool is_feature(int edge) const { return domain::is_feature(surface_.topology, face_, edge); }

  // The end of the way, in the present face.
  SurfacePoint end() const {
    SurfacePoint point;
    point.face = face_;
    for (int k = 0; k < 3; ++k)
      point.weights[kPrev[k]] = std::max(0.0, height_over(k, origin_ + way_));
    const double sum = point.weights.sum();
    // In a face without area the way ends on the edge it came in by: any corner will do.
    point.weights = sum > 0 ? (point.weights / sum).eval() : Vector3d(1, 0, 0);
    return point;
  }

  // Where the way meets an edge of the present face.
  SurfacePoint meet(int edge) const {
    const double before = cross(way_, corners_[edge] - origin_);
    const double after = cross(way_, corners_[kNext[edge]] - origin_);
    const double along = before == after ? 0.5 : std::clamp(before / (before - after), 0.0, 1.0);
    SurfacePoint point;
    point.face = face_;
    point.weights[edge] = 1 - along;
    point.weights[kNext[edge]] = along;
    return point;
  }

 private:
  double height_over(int edge, const Vector2d& point) const {
    return cross(corners_[kNext[edge]] - corners_[edge], point - corners_[edge]);
  }

  const InputSurface& surface_;
  std::uint32_t face_;
  std::array<Vector2d, 3> corners_;  // of the present face
  Vector2d origin_, way_;
  bool has_area_;
};

}  // namespace

SurfacePoint walk_on_surface(const InputSurface& surface, const SurfacePoint& start,
                             const Eigen::Vector3d& displacement) {
  UnfoldedWay way(surface, start, displacement);
  if (!way.has_area()) return {start.face, -1, start.weights};
  int exit = way.first_exit();
  for (int crossed = 0; exit >= 0; ++crossed) {
    if (way.is_feature(exit) || crossed == kMostFaces) return way.meet(exit);
    exit = way.cross_edge(exit);
  }
  return way.end();
}

}  // namespace zerotree::relax
