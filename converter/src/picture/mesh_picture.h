// A shaded picture of a mesh.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "mesh/triangle_mesh.h"
#include "picture/camera.h"
#include "picture/image.h"

namespace zerotree::picture {

struct RenderOptions {
  /// Size of the image in pixels.
  int width = 720;
  int height = 720;
  /// From the model to the viewer; zero chooses a three-quarter view (automatic_view.h).
  Eigen::Vector3d view_direction = Eigen::Vector3d::Zero();
  /// The direction that is upwards in the image; zero chooses one.
  Eigen::Vector3d up = Eigen::Vector3d::Zero();
  /// Shades each triangle by its plane instead of smoothly.
  bool flat = false;
  /// Share of the image that stays free on every side.
  double margin = 0.05;
  /// Draws the model's soft shadow on the ground it stands on.
  bool ground_shadow = true;
  /// Lights the model from the viewer, without shadows: its colours then mean the same everywhere.
  bool even_light = false;
  /// Samples per pixel along each axis.
  int supersampling = 4;
  /// Rays of ambient occlusion per sample.
  int sky_rays = 3;
  /// Threads to use; 0 means all of the machine's. The image does not depend on it.
  int threads = 0;
};

/// A mesh and what is drawn with it. Refers to the mesh, which must outlive it.
struct Model {
  const TriangleMesh* mesh = nullptr;
  /// Unit normals, one per vertex; empty: computed from the triangles.
  std::vector<Eigen::Vector3f> normals = {};
  /// Linear red, green and blue in 0..1, one per vertex; empty: the colour of clay.
  std::vector<Eigen::Vector3f> colours = {};
};

/// Unit normals, one per vertex: the mean of the adjacent triangles' weighted by their angles (Max
/// 1999 compares the choices); zero at vertices that no triangle of positive area uses.
std::vector<Eigen::Vector3f> vertex_normals(const TriangleMesh& mesh);

/// The camera that `options` ask for, fitted to `mesh`.
Camera choose_camera(const TriangleMesh& mesh, const RenderOptions& options);

/// The model seen by `camera`, on nothing: coverage 0 where there is no model and no shadow. Both
/// sides of a surface are drawn. Throws Error(refused_topology) for a mesh that is empty, not
/// finite or has indices out of range, Error(usage) for options out of range or normals or colours
/// of another number than vertices. Cost: about 15 s on one core for 720 x 720 pixels.
Image render(const Model& model, const Camera& camera, const RenderOptions& options);

/// The mesh as `options` say, on a background of light paper.
Image render(const TriangleMesh& mesh, const RenderOptions& options = {});

}  // namespace zerotree::picture
