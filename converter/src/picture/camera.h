// Where the viewer stands.
#pragma once

#include <Eigen/Core>

#include "mesh/triangle_mesh.h"

namespace zerotree::picture {

/// Moves a mesh's own coordinates into the unit frame in which pictures are computed: the bounding
/// box of the mesh the picture is about is centred and its diagonal is 2.
struct UnitFrame {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double scale = 1.0;

  Eigen::Vector3f operator()(const Eigen::Vector3d& p) const {
    return ((p - centre) * scale).cast<float>();
  }
};

/// The directions of a view: unit vectors, orthogonal, `right` x `up` = `back` (to the viewer).
struct ViewAxes {
  Eigen::Vector3f right, up, back;
};

/// A perspective camera in the unit frame.
struct Camera {
  UnitFrame frame;
  ViewAxes axes;
  Eigen::Vector3f eye;
  /// Tangent of half the opening angle along the image's width and height.
  float tangent_x = 0.0F, tangent_y = 0.0F;
  /// The direction in which the model stands upright, and the height along it of the ground.
  Eigen::Vector3f world_up;
  float ground = 0.0F;

  /// Direction (not normalised) of the ray through image position x, y in 0..1, y downwards.
  Eigen::Vector3f ray(float x, float y) const {
    return (2.0F * x - 1.0F) * tangent_x * axes.right + (1.0F - 2.0F * y) * tangent_y * axes.up -
           axes.back;
  }
};

/// The frame of the vertices that triangles use. Throws Error(refused_topology) for a mesh that
/// has no extent or is not finite.
UnitFrame unit_frame(const TriangleMesh& mesh);

/// Axes of a view from direction `back` (from the model to the viewer) with `up` upwards as well as
/// it can be. Neither may be zero; where they are parallel another upward direction is taken.
ViewAxes view_axes(const Eigen::Vector3d& back, const Eigen::Vector3d& up);

/// The camera that sees the whole mesh as large as possible, with `margin` (a share of the image)
/// left free on every side, in an image of `aspect` = width / height.
Camera fit_camera(const TriangleMesh& mesh, const Eigen::Vector3d& back, const Eigen::Vector3d& up,
                  double aspect, double margin);

}  // namespace zerotree::picture
