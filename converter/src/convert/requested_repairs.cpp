#include "convert/requested_repairs.h"

#include <utility>

#include "clean/manifold_check.h"
#include "mesh/error.h"
#include "repair/handle_removal.h"
#include "repair/hole_filling.h"

namespace zerotree::convert {
namespace {

bool fill_holes(TriangleMesh& mesh, const ConvertOptions& options, report::ConvertReport& report,
                const Progress& progress) {
  const double size = options.fill_holes * report.diagonal + options.fill_holes_metres;
  repair::FilledMesh filled = repair::fill_holes(mesh, {.size = size}, progress);
  for (double length : filled.report.filled_rims)
    report.filled_rims.push_back(length / report.diagonal);
  for (double length : filled.report.left_rims)
    report.left_rims.push_back(length / report.diagonal);
  report.filling_faces = filled.report.added_faces;
  mesh = std::move(filled.mesh);
  return !filled.report.filled_rims.empty();
}

bool remove_handles(TriangleMesh& mesh, const ConvertOptions& options,
                    report::ConvertReport& report, const Progress& progress) {
  const double size = options.remove_handles * report.diagonal + options.remove_handles_metres;
  repair::HandleFreeMesh freed = repair::remove_handles(mesh, {.size = size}, progress);
  report.genus_before = freed.report.genus_before;
  for (double length : freed.report.loops) report.handle_loops.push_back(length / report.diagonal);
  mesh = std::move(freed.mesh);
  return !freed.report.loops.empty();
}

void note_topology(const TriangleMesh& mesh, report::ConvertReport& report) {
  if (const std::string problem = clean::check_manifold(mesh); !problem.empty())
    throw Error(ExitCode::internal, std::string("a repair left a surface that is no manifold: ")
                                        .append(problem)
                                        .append("; please report this file"));
  const clean::SurfaceTopology topology = clean::measure_topology(mesh);
  report.components = topology.component_count;
  report.boundary_loops = topology.boundary_loops;
  report.genus = topology.genus;
  report.clean_vertices = mesh.positions.size();
  report.clean_faces = mesh.triangles.size();
}

}  // namespace

bool make_requested_repairs(TriangleMesh& mesh, const ConvertOptions& options,
                            report::StageClock& clock, report::ConvertReport& report,
                            const Progress& progress) {
  bool changed = false;
  if (options.fill_holes > 0 || options.fill_holes_metres > 0)
    changed = clock.run("fill holes", [&] { return fill_holes(mesh, options, report, progress); });
  if (options.remove_handles > 0 || options.remove_handles_metres > 0)
    changed |= clock.run("remove handles",
                         [&] { return remove_handles(mesh, options, report, progress); });
  if (changed) note_topology(mesh, report);
  return changed;
}

}  // namespace zerotree::convert
