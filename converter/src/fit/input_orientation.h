// Which way the input looks beside the faces of the fitted surface.
#pragma once

#include <vector>

#include "fit/limit_operator.h"
#include "relax/surface_walk.h"

namespace zerotree::fit {

/// The normals of the input, as faces that lie on it are compared with. Refers to the input.
class InputOrientation {
 public:
  explicit InputOrientation(const relax::InputSurface& input);

  /// Whether a point keeps to a feature curve or lies at a vertex on one.
  bool is_on_feature(const relax::SurfacePoint& point) const;

  /// Unit normal at a point: interpolated from those of the vertices, but that vertices on features
  /// have the one of the point's face.
  Eigen::Vector3d smooth_normal(const relax::SurfacePoint& point) const;

  /// The input's point at the centre of the triangle `t` of limit points: the nearest one that
  /// short walks from the feet of its corners lead to. Those on features are on no side and lead
  /// nowhere; false if there are no others.
  bool find_point(const std::vector<relax::SurfacePoint>& feet, const Points& limit,
                  const Triangle& t, relax::SurfacePoint& point) const;

  /// Whether a normal opposes the input's at a point, its face's own and the smooth one: noise is
  /// no turn.
  bool opposes(const relax::SurfacePoint& point, const Eigen::Vector3d& normal) const;

  /// Whether the normal of the triangle `t` of limit points opposes the input's at its point.
  bool is_turned(const std::vector<relax::SurfacePoint>& feet, const Points& limit,
                 const Triangle& t) const;

  const relax::InputSurface& input() const { return input_; }

 private:
  const relax::InputSurface& input_;
  // Of unit length; zero on features.
  Points normals_;
};

}  // namespace zerotree::fit
