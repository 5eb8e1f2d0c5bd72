// A picture of what each stage of a conversion made, for people who look for what went wrong.
#pragma once

#include <filesystem>

#include "convert/surface_model.h"
#include "measure/surface_index.h"
#include "mesh/progress.h"
#include "mesh/triangle_mesh.h"
#include "report/convert_report.h"

namespace zerotree::convert {

/// What the pictures show. Refers to the stages' results, which must outlive it.
struct PictureSubject {
  /// As the domain was built from; the camera is fitted to it.
  const TriangleMesh& input;
  /// What distances are measured to.
  const measure::SurfaceIndex& original;
  /// With its relaxed mesh.
  const SurfaceModel& model;
  /// Of each level and edge: normal, tangent 1, tangent 2.
  const std::vector<std::vector<Eigen::Vector3d>>& local_details;
  const report::ConvertReport& report;
};

/// Makes the folder unless it is there. Throws Error(usage) naming it if that cannot be done.
void make_picture_folder(const std::filesystem::path& folder);

/// Writes base.png (base mesh, creases, corners), parameter-lines.png (edges of a coarser level on
/// the relaxed mesh, which lies on the input), error.png (distance of the remesh from the input)
/// and detail-energy.png (size of the normal and tangential details, level by level) to `folder`.
/// The pictures do not depend on the number of threads. Throws Error if a file cannot be written.
/// Cost: about ten seconds on one core.
void write_debug_pictures(const std::filesystem::path& folder, const PictureSubject& subject,
                          int threads, const Progress& progress);

}  // namespace zerotree::convert
