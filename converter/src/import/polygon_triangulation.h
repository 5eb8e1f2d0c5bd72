// Cuts polygons into triangles.
#pragma once

#include "import/polygon_mesh.h"

namespace zerotree::importer {

/// The triangles of all polygons of `mesh`, in order, with the polygons' orientation. A quad is cut
/// along its shorter diagonal inside it; a polygon of more corners by ear clipping in the plane of
/// its area vector, so concave ones come out right. A polygon that crosses itself or has no area is
/// still cut into corners - 2 triangles. Linear in the triangles, quadratic in a polygon's corners.
std::vector<Triangle> triangulate(const PolygonMesh& mesh);

}  // namespace zerotree::importer
