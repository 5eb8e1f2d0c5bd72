#include "convert/limit_mesh.h"

#include "decode/prefix_surface.h"
#include "surface/surface_synthesis.h"

namespace zerotree::convert {

TriangleMesh limit_mesh(const SurfaceModel& model) {
  surface::Positions points;
  points.reserve(model.control_points.size() * 3);
  for (const Eigen::Vector3d& p : model.control_points)
    for (int k = 0; k < 3; ++k) points.push_back(static_cast<float>(p[k]));
  const surface::SubdivisionLevel& finest = model.hierarchy->level(model.hierarchy->levels());
  exporter::Surface limit;
  limit.positions.resize(finest.vertex_count);
  limit.triangles = finest.triangles;
  surface::limit_surface(finest, points, {limit.positions.data(), sizeof(Eigen::Vector3f)}, {});
  return decode::to_triangle_mesh(limit);
}

}  // namespace zerotree::convert
