// A mesh fitted to itself, as what follows the fit finds it.
#pragma once

#include "fit/input_orientation.h"
#include "fit/surface_fit.h"
#include "fit/turned_faces.h"
#include "scans.h"

namespace zerotree::test {

/// A mesh fitted to itself.
struct Fitted {
  Fitted(const TriangleMesh& mesh, const domain::DomainOptions& options)
      : domain(domain::build_domain(mesh, options, {})),
        laid_out(remesh::remesh(domain, {.levels = 3}, {}).laid_out),
        relaxed(relax::relax(domain, laid_out, 3, {}, {})),
        limit(relaxed.mesh.base, finest()),
        held(finest().vertex_count, 0),
        points(fit::fit_control_points(domain, laid_out, relaxed, {}, {}).points) {
    for (std::size_t e = 0; e < finest().edges.size(); ++e)
      if (finest().is_feature[e]) held[finest().edges[e][0]] = held[finest().edges[e][1]] = 1;
  }
  const relax::SubdividedLevel& finest() const { return relaxed.levels.back(); }
  relax::InputSurface input() const { return {domain.mesh, laid_out.charts.topology}; }
  /// Turns the surface back from `from`.
  std::uint32_t turn_back(fit::Points& from) const {
    const relax::InputSurface surface = input();
    std::vector<relax::SurfacePoint> feet = relaxed.points;
    return fit::turn_faces_back(fit::InputOrientation(surface), finest(), limit, held, feet, from);
  }
  /// How many faces of the limit surface are turned, by the normals at their corners' feet.
  int count_turned(const fit::Points& from) const {
    const relax::InputSurface surface = input();
    const fit::InputOrientation orientation(surface);
    fit::Points at;
    limit.apply(from, at);
    int turned = 0;
    for (const Triangle& t : finest().triangles)
      turned += orientation.is_turned(relaxed.points, at, t);
    return turned;
  }

  domain::Domain domain;
  remesh::Parameterisation laid_out;
  relax::RelaxedMesh relaxed;
  fit::LimitOperator limit;
  std::vector<std::uint8_t> held;
  fit::Points points;
};

}  // namespace zerotree::test
