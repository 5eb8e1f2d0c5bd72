#include "convert/surface_model.h"

#include <algorithm>
#include <utility>

#include "analysis/wavelet_analysis.h"
#include "clean/clean_mesh.h"
#include "clean/spatial_order.h"
#include "domain/domain.h"
#include "fit/surface_fit.h"
#include "relax/surface_relaxation.h"
#include "remesh/remesh.h"

namespace zerotree::convert {
namespace {

void note_clean(const clean::CleanMesh& cleaned, report::ConvertReport& report) {
  for (const auto& [what, count] : clean::list_repairs(cleaned.report))
    report.repairs.push_back({what, count});
  report.clean_vertices = cleaned.mesh.positions.size();
  report.clean_faces = cleaned.mesh.triangles.size();
  report.components = cleaned.report.components;
  report.boundary_loops = cleaned.report.boundary_loops;
  report.genus = cleaned.report.genus;
}

void note_remesh(const remesh::RemeshResult& remeshed, report::ConvertReport& report) {
  report.base_vertices = remeshed.report.base_vertices;
  report.base_faces = remeshed.report.base_faces;
  report.crease_edges = remeshed.report.base_crease_edges;
  report.corners = remeshed.report.base_corners;
  report.levels = remeshed.report.levels;
  report.finest_vertices = remeshed.report.finest_vertices;
  report.pinned_limbs = remeshed.report.pinned_limbs;
  report.cone_swaps = remeshed.report.cone_swaps;
}

// What is kept of the remesh: everything else is freed before the surface's topology is built.
struct RemeshedSurface {
  bitstream::BaseTopology base;
  int levels = 0;
  std::vector<Eigen::Vector3d> control_points;
  /// Only if pictures were asked for.
  std::shared_ptr<const relax::RelaxedMesh> relaxed;
};

// The error asked for, relative to the diagonal; 0 if none was.
double asked_error(const ConvertOptions& options, const report::ConvertReport& report) {
  return options.max_error + options.max_error_metres / report.diagonal;
}

// Detail far below the error asked for is not worth its bits: the farther that is above the input's
// own discretisation error, the smoother the fit.
fit::FitOptions fit_options_for(const ConvertOptions& options,
                                const report::ConvertReport& report) {
  constexpr double most = 1.0;  // at which the details of the finest level count as distances
  fit::FitOptions fit_options;
  const double asked = asked_error(options, report);
  if (asked <= report.discretisation_error || report.discretisation_error <= 0) return fit_options;
  const double ratio = asked / report.discretisation_error;
  fit_options.smoothness.normal = std::min(most, fit_options.smoothness.normal * ratio * ratio);
  return fit_options;
}

RemeshedSurface remesh_surface(const TriangleMesh& mesh, const ConvertOptions& options,
                               report::StageClock& clock, report::ConvertReport& report,
                               const Progress& progress) {
  domain::DomainOptions domain_options;
  domain_options.base_vertices = static_cast<std::uint32_t>(options.base_vertices);
  domain_options.crease_angle_degrees = options.crease_angle_degrees;
  const domain::AccuracyGoal goal{asked_error(options, report), report.discretisation_error};
  domain_options.goal = goal;
  domain::Domain domain =
      clock.run("domain", [&] { return domain::build_domain(mesh, domain_options, progress); });

  remesh::RemeshOptions remesh_options;
  remesh_options.levels = options.levels;
  remesh_options.goal = goal;
  const remesh::RemeshResult remeshed =
      clock.run("remesh", [&] { return remesh::remesh(domain, remesh_options, progress); });
  note_remesh(remeshed, report);
  // The way from the mesh to its base has been gone.
  domain.topology = domain::TriangleTopology();
  std::vector<domain::CollapseRecord>().swap(domain.collapses);

  relax::RelaxedMesh relaxed = clock.run("relax", [&] {
    return relax::relax(domain, remeshed.laid_out, remeshed.report.levels, {}, progress);
  });
  report.rejected_moves = relaxed.report.rejected_moves;
  report.negative_triangles = relaxed.report.negative_triangles;
  RemeshedSurface result{relaxed.mesh.base, relaxed.mesh.levels, {}, nullptr};
  if (!options.debug_pictures.empty())
    result.relaxed = std::make_shared<const relax::RelaxedMesh>(relaxed);
  fit::FittedSurface fitted = clock.run("fit", [&] {
    return fit::fit_control_points(domain, remeshed.laid_out, std::move(relaxed),
                                   fit_options_for(options, report), progress);
  });
  report.turned_faces = fitted.turned_faces;
  result.control_points = std::move(fitted.points);
  return result;
}

}  // namespace

TriangleMesh clean_input(const TriangleMesh& mesh, report::StageClock& clock,
                         report::ConvertReport& report, const Progress& progress) {
  clean::CleanMesh cleaned = clock.run("clean", [&] {
    clean::CleanMesh result = clean::clean_mesh(mesh, {}, progress);
    clean::sort_spatially(result.mesh);
    return result;
  });
  note_clean(cleaned, report);
  return std::move(cleaned.mesh);
}

SurfaceModel build_surface_model(const TriangleMesh& mesh, const ConvertOptions& options,
                                 report::StageClock& clock, report::ConvertReport& report,
                                 const Progress& progress) {
  RemeshedSurface remeshed = remesh_surface(mesh, options, clock, report, progress);
  SurfaceModel model;
  model.base = remeshed.base;
  model.control_points = std::move(remeshed.control_points);
  model.relaxed = std::move(remeshed.relaxed);
  model.hierarchy = clock.run("topology", [&] {
    const auto transform = options.transform == TransformChoice::mirror
                               ? surface::WaveletTransform::loop_quadrature_mirror
                               : surface::WaveletTransform::loop_local;
    return std::make_shared<const surface::SubdivisionHierarchy>(model.base, remeshed.levels,
                                                                 transform);
  });
  return model;
}

analysis::WaveletDecomposition analyse_model(const SurfaceModel& model,
                                             const ConvertOptions& options,
                                             report::StageClock& clock, const Progress& progress) {
  analysis::AnalysisOptions analysis_options;
  analysis_options.transform = model.hierarchy->transform();
  analysis_options.threads = options.threads;
  return clock.run("analysis", [&] {
    return analysis::analyse(*model.hierarchy, model.control_points, analysis_options, progress);
  });
}

}  // namespace zerotree::convert
