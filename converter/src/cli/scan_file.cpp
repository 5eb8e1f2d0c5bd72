#include "cli/scan_file.h"

#include <utility>

#include "cli/quantities.h"
#include "convert/convert.h"
#include "convert/requested_repairs.h"
#include "convert/surface_model.h"
#include "import/import_mesh.h"
#include "report/convert_report.h"
#include "report/stage_clock.h"

namespace zerotree::cli {
namespace {

void set_size(const std::string& text, const char* option, double& relative, double& metres) {
  if (text.empty()) return;
  const Distance size = parse_distance(text, option);
  (size.in_metres ? metres : relative) = size.value;
}

}  // namespace

Scan read_scan(const std::filesystem::path& path, const RequestedRepairs& repairs,
               const Progress& progress) {
  convert::ConvertOptions options;
  set_size(repairs.fill_holes, "--fill-holes", options.fill_holes, options.fill_holes_metres);
  set_size(repairs.remove_handles, "--remove-handles", options.remove_handles,
           options.remove_handles_metres);
  Scan scan{importer::import_mesh(path, {}, progress).mesh, 0};
  scan.diagonal = bounding_box_diagonal(scan.mesh.positions);
  if (repairs.fill_holes.empty() && repairs.remove_handles.empty()) return scan;
  report::StageClock clock;
  report::ConvertReport report;
  report.diagonal = scan.diagonal;
  TriangleMesh changed = convert::clean_input(scan.mesh, clock, report, progress);
  if (convert::make_requested_repairs(changed, options, clock, report, progress))
    scan.mesh = std::move(changed);
  return scan;
}

}  // namespace zerotree::cli
