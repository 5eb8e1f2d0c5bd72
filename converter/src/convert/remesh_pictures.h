// Pictures of the base mesh, the parameter lines and the remesh's error.
#pragma once

#include <string>

#include "convert/debug_pictures.h"
#include "picture/camera.h"
#include "picture/image.h"
#include "picture/mesh_picture.h"

namespace zerotree::convert {

/// How all pictures of a conversion are taken.
struct PictureView {
  picture::RenderOptions render;
  picture::Camera camera;
};

/// The input file's name, for captions.
std::string name_of(const PictureSubject& subject);

/// The base mesh, each face shaded by its plane, with its edges, creases, boundary and corners.
picture::Image draw_base(const PictureSubject& subject, const PictureView& view);

/// The relaxed mesh of the finest level with the base's edges and those of the finest level whose
/// triangles can be told apart.
picture::Image draw_parameter_lines(const PictureSubject& subject, const PictureView& view);

/// `limit`, the remesh, coloured by each vertex's distance from the input.
picture::Image draw_error(const PictureSubject& subject, const TriangleMesh& limit,
                          const PictureView& view);

}  // namespace zerotree::convert
