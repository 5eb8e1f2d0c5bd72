#include "convert/convert.h"

#include <tbb/global_control.h>
#include <tbb/info.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "analysis/local_details.h"
#include "convert/debug_pictures.h"
#include "convert/encoded_outputs.h"
#include "convert/limit_mesh.h"
#include "convert/output_files.h"
#include "convert/prefix_errors.h"
#include "convert/requested_repairs.h"
#include "convert/surface_model.h"
#include "convert/transform_choice.h"
#include "discretisation/discretisation_error.h"
#include "import/import_mesh.h"
#include "measure/surface_distance.h"
#include "mesh/error.h"
#include "report/remesh_remark.h"
#include "report/stage_clock.h"

namespace zerotree::convert {
namespace {

// Samples of each surface for a quick measurement: the RMS is good to about one percent, where no
// part of the input is far from the remesh.
constexpr std::size_t kTableSamples = 50'000;
// Most memory a conversion takes per input vertex, in bytes; from 100,000 vertices on it is half.
constexpr std::uint64_t kMemoryPerVertex = 5000;

void check_memory(const ConvertOptions& options, std::uint64_t vertices) {
  const std::uint64_t needed = vertices * kMemoryPerVertex;
  if (options.memory_limit == 0 || needed <= options.memory_limit) return;
  throw Error(ExitCode::memory_limit,
              options.input.string() + ": " + std::to_string(vertices) + " vertices need about " +
                  std::to_string((needed >> 20) + 1) +
                  " MiB, more than --memory-limit allows; simplify the mesh, cut it into parts, "
                  "or allow more");
}

// The stages after import do not know the file they work on; the person who reads their error does.
template <class Stages>
auto name_input_in_errors(const std::filesystem::path& input, Stages&& stages) {
  try {
    return stages();
  } catch (const Error& error) {
    throw Error(error.code(), input.string().append(": ").append(error.what()));
  }
}

void note_input(const ConvertOptions& options, const importer::ImportedMesh& imported,
                report::ConvertReport& report) {
  report.input = options.input.string();
  report.format = imported.format;
  report.input_vertices = imported.mesh.positions.size();
  report.input_faces = imported.mesh.triangles.size();
  report.diagonal = bounding_box_diagonal(imported.mesh.positions);
  report.not_carried = imported.not_carried;
}

PrefixMeasurement measurement_of(const measure::SurfaceIndex& original, const SurfaceModel& model,
                                 const ConvertOptions& options,
                                 const report::ConvertReport& report) {
  return {original,
          {kTableSamples, options.threads},
          report.input_vertices,
          report.diagonal,
          model.hierarchy};
}

// Distance between the input and the limit surface of the control points before quantisation.
double remeshing_error(const SurfaceModel& model, const PrefixMeasurement& how) {
  return measure::compare_surfaces(how.original, limit_mesh(model), how.distance).relative_rms();
}

// Root mean squares of the details of each level, relative to the diagonal.
std::vector<report::LevelDetails> level_details(
    const std::vector<std::vector<Eigen::Vector3d>>& local_details, double diagonal) {
  std::vector<report::LevelDetails> levels;
  for (const std::vector<Eigen::Vector3d>& details : local_details) {
    double normal = 0, tangential = 0;
    for (const Eigen::Vector3d& d : details) {
      normal += d[0] * d[0];
      tangential += d[1] * d[1] + d[2] * d[2];
    }
    const double count = std::max<double>(1, static_cast<double>(details.size()));
    levels.push_back(
        {std::sqrt(normal / count) / diagonal, std::sqrt(tangential / count) / diagonal});
  }
  return levels;
}

}  // namespace

report::ConvertReport convert_file(const ConvertOptions& asked, const Progress& progress) {
  check_outputs(asked);
  if (!asked.debug_pictures.empty()) make_picture_folder(asked.debug_pictures);
  ConvertOptions options = asked;
  if (options.threads == 0) options.threads = tbb::info::default_concurrency();
  const tbb::global_control thread_limit(tbb::global_control::max_allowed_parallelism,
                                         static_cast<std::size_t>(options.threads));
  report::ConvertReport report;
  report::StageClock clock;

  const importer::ImportedMesh imported =
      clock.run("import", [&] { return importer::import_mesh(options.input, {}, progress); });
  note_input(options, imported, report);
  check_memory(options, report.input_vertices);

  measure::SurfaceIndex original = name_input_in_errors(options.input, [&] {
    return clock.run("index",
                     [&] { return measure::SurfaceIndex(imported.mesh, options.threads); });
  });
  TriangleMesh cleaned;
  SurfaceModel model = name_input_in_errors(options.input, [&] {
    cleaned = clean_input(imported.mesh, clock, report, progress);
    // What was asked to be changed is no error: measure against the changed surface.
    if (make_requested_repairs(cleaned, options, clock, report, progress))
      original = measure::SurfaceIndex(cleaned, options.threads);
    report.discretisation_error = clock.run("discretisation", [&] {
      return discretisation::discretisation_error(
                 cleaned, original, {.crease_angle_degrees = options.crease_angle_degrees}) /
             report.diagonal;
    });
    return build_surface_model(cleaned, options, clock, report, progress);
  });
  PrefixMeasurement how = measurement_of(original, model, options, report);
  report.remeshing_error = clock.run("measure remesh", [&] { return remeshing_error(model, how); });
  report.remesh_remark = report::explain_remeshing_error(report);
  const AnalysedModel analysed =
      analyse_with_choice(std::move(model), options, how, clock, report, progress);
  how.hierarchy = analysed.model.hierarchy;
  const auto local_details = analysis::local_details(*how.hierarchy, analysed.wavelets);
  report.level_details = level_details(local_details, report.diagonal);
  if (!options.debug_pictures.empty())
    clock.run("pictures", [&] {
      write_debug_pictures(options.debug_pictures,
                           {cleaned, original, analysed.model, local_details, report},
                           options.threads, progress);
    });
  write_outputs(analysed, options, how, clock, report, progress);
  if (!options.glb.empty()) report.file_bytes = std::filesystem::file_size(options.glb);
  report.stages = clock.costs();
  return report;
}

}  // namespace zerotree::convert
