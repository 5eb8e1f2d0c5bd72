// The stages from triangles to wavelets: clean, domain, remesh, fit, analysis.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "analysis/wavelet_decomposition.h"
#include "bitstream/base_topology.h"
#include "convert/convert.h"
#include "mesh/triangle_mesh.h"
#include "relax/surface_relaxation.h"
#include "report/convert_report.h"
#include "report/stage_clock.h"
#include "surface/subdivision_hierarchy.h"

namespace zerotree::convert {

/// A surface ready to be encoded.
struct SurfaceModel {
  bitstream::BaseTopology base;
  /// All levels over `base`, for the transform asked for; for the local one if none is.
  std::shared_ptr<const surface::SubdivisionHierarchy> hierarchy;
  /// Of the finest level, before quantisation.
  std::vector<Eigen::Vector3d> control_points;
  /// Only if pictures were asked for.
  std::shared_ptr<const relax::RelaxedMesh> relaxed;
};

/// Repairs `mesh` and notes in `report` what was found and done.
TriangleMesh clean_input(const TriangleMesh& mesh, report::StageClock& clock,
                         report::ConvertReport& report, const Progress& progress);

/// Domain, remesh and fit of the clean `mesh`, noted in `report`.
SurfaceModel build_surface_model(const TriangleMesh& mesh, const ConvertOptions& options,
                                 report::StageClock& clock, report::ConvertReport& report,
                                 const Progress& progress);

/// The wavelets of the model's control points by the transform of its hierarchy.
analysis::WaveletDecomposition analyse_model(const SurfaceModel& model,
                                             const ConvertOptions& options,
                                             report::StageClock& clock, const Progress& progress);

}  // namespace zerotree::convert
