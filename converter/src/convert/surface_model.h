// The stages from triangles to wavelets: clean, domain, remesh, fit, analysis.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "analysis/wavelet_decomposition.h"
#include "bitstream/base_topology.h"
#include "convert/convert.h"
#include "mesh/triangle_mesh.h"
#include "report/convert_report.h"
#include "report/stage_clock.h"
#include "surface/subdivision_hierarchy.h"

namespace zerotree::convert {

/// A surface ready to be encoded.
struct SurfaceModel {
  bitstream::BaseTopology base;
  /// All levels over `base`.
  std::shared_ptr<const surface::SubdivisionHierarchy> hierarchy;
  /// Of the finest level, before quantisation.
  std::vector<Eigen::Vector3d> control_points;
  analysis::WaveletDecomposition wavelets;
};

/// Runs the stages on `mesh` and notes in `report` what they found and did.
SurfaceModel build_surface_model(const TriangleMesh& mesh, const ConvertOptions& options,
                                 report::StageClock& clock, report::ConvertReport& report,
                                 const Progress& progress);

}  // namespace zerotree::convert
