// The surface of a model before anything of it is quantised.
#pragma once

#include "convert/surface_model.h"
#include "mesh/triangle_mesh.h"

namespace zerotree::convert {

/// The limit points of the model's control points: vertices and triangles of its finest level.
TriangleMesh limit_mesh(const SurfaceModel& model);

}  // namespace zerotree::convert
