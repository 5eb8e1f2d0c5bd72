// Lines and dots on a surface that was drawn.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "mesh/triangle_mesh.h"
#include "picture/camera.h"
#include "picture/image.h"

namespace zerotree::picture {

/// Lines of one colour and width. A segment of length 0 is a dot.
struct Lines {
  Pixel colour{0, 0, 0, 255};
  /// In pixels; the ends are round.
  float width = 1.0F;
  /// In the coordinates of the mesh they lie on.
  std::vector<std::array<Eigen::Vector3d, 2>> segments;
};

/// Draws the parts of `layers`, the first one lowest, that `mesh` does not hide from `camera`, on
/// the opaque `image` of it. Lines may lie on the surface or a little below it: by less than a
/// five thousandth of the mesh's diagonal they count as visible. Throws what RayScene throws. Cost:
/// a ray for each pixel of length.
void draw_lines(Image& image, const std::vector<Lines>& layers, const TriangleMesh& mesh,
                const Camera& camera);

}  // namespace zerotree::picture
