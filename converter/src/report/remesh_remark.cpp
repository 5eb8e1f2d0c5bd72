#include "report/remesh_remark.h"

#include <cstdio>

namespace zerotree::report {
namespace {

constexpr double kTolerable = 3;
// An input that its own smooth surface follows so closely is made of planes.
constexpr double kFlat = 1e-6;
// Fewer faces than this per face of the input cannot show what it shows.
constexpr double kLeastFaceRatio = 1;
// Base vertices that handles, boundary loops and components of their own need each.
constexpr std::uint64_t kVerticesPerPart = 6;

std::string likely_cause(const ConvertReport& r) {
  const double faces = static_cast<double>(r.base_faces << (2 * r.levels));
  if (faces < kLeastFaceRatio * static_cast<double>(r.clean_faces))
    return "the finest mesh has fewer faces than the input; allow more --levels";
  if (r.discretisation_error < kFlat)
    return r.crease_edges > 0
               ? "the input is made of flat faces, and edges between them that are no creases are "
                 "rounded; try another --crease-angle"
               : "the input is made of flat faces without creases, and a smooth surface rounds the "
                 "edges between them; try --crease-angle";
  const std::uint64_t parts =
      r.components + r.boundary_loops + static_cast<std::uint64_t>(r.genus > 0 ? r.genus : 0);
  if (2 * kVerticesPerPart * parts > r.base_vertices && parts > 2)
    return std::to_string(r.components)
        .append(" components, ")
        .append(std::to_string(r.boundary_loops))
        .append(" boundary loops and ")
        .append(std::to_string(r.genus))
        .append(" handles take most of the base's vertices; ask for more --base-vertices");
  return "the base mesh is too coarse for thin or detailed parts of the surface; ask for more "
         "--base-vertices";
}

}  // namespace

std::string explain_remeshing_error(const ConvertReport& report) {
  if (report.remeshing_error <= kTolerable * report.discretisation_error) return {};
  char errors[120];
  std::snprintf(
      errors, sizeof errors,
      "the remesh error of %.2g is more than three times the discretisation error of %.2g: ",
      report.remeshing_error, report.discretisation_error);
  return std::string(errors).append(likely_cause(report));
}

}  // namespace zerotree::report
