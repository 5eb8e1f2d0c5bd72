#include "convert/convert.h"

#include <tbb/global_control.h>
#include <tbb/info.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "analysis/local_details.h"
#include "convert/base_grid.h"
#include "convert/debug_pictures.h"
#include "convert/limit_mesh.h"
#include "convert/measured_stream.h"
#include "convert/output_files.h"
#include "convert/prefix_table.h"
#include "convert/requested_repairs.h"
#include "convert/surface_model.h"
#include "decode/prefix_surface.h"
#include "discretisation/discretisation_error.h"
#include "encode/encode.h"
#include "export/atomic_file.h"
#include "gltf/progressive_writer.h"
#include "import/import_mesh.h"
#include "measure/surface_distance.h"
#include "mesh/error.h"
#include "report/remesh_remark.h"
#include "report/stage_clock.h"
#include "surface/surface_synthesis.h"

namespace zerotree::convert {
namespace {

// Samples of each surface for the table: the RMS is good to about one percent.
constexpr std::size_t kTableSamples = 50'000;
// The finest step in units of the remeshing error: rounding then adds less than that to it.
constexpr double kStepPerRemeshingError = 1.0;
// ... but never finer than this part of the diagonal, about what float positions resolve.
constexpr double kFinestRelativeStep = 1e-7;
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

// Limit normals of the base: what an unaware viewer shades the base with.
std::vector<Eigen::Vector3f> base_normals(const surface::SubdivisionHierarchy& hierarchy,
                                          const surface::Positions& base_positions) {
  const surface::SubdivisionLevel& base = hierarchy.level(0);
  std::vector<Eigen::Vector3f> normals(base.vertex_count);
  surface::limit_surface(base, base_positions, {}, {normals.data(), sizeof(Eigen::Vector3f)});
  return normals;
}

decode::StreamFile encode_model(const SurfaceModel& model,
                                const analysis::WaveletDecomposition& wavelets, double finest_step,
                                bool embed_base) {
  encode::EncodeOptions options;
  options.finest_step = finest_step;
  options.embed_base = embed_base;
  encode::EncodedStream encoded = encode::encode(*model.hierarchy, wavelets, options);
  decode::StreamFile file;
  file.bytes = std::move(encoded.bytes);
  file.external_base = !embed_base;
  file.base = model.base;
  file.levels = model.hierarchy->levels();
  file.base_positions = std::move(encoded.base_positions);
  return file;
}

// For glTF: bound to the base of the accessors, which lies on a grid if it is to be compressed.
decode::StreamFile encode_payload(const SurfaceModel& model,
                                  const analysis::WaveletDecomposition& wavelets,
                                  double finest_step, const ConvertOptions& options) {
  if (!options.compress_base) return encode_model(model, wavelets, finest_step, false);
  const gltf::Placement grid = grid_for(wavelets.base_control_points);
  decode::StreamFile file =
      encode_model(model, on_grid(wavelets, grid), finest_step / grid.scale, false);
  file.placement = grid;
  return file;
}

gltf::ProgressiveAsset measure_asset(const SurfaceModel& model, const decode::StreamFile& file,
                                     const ConvertOptions& options, const PrefixMeasurement& how,
                                     report::ConvertReport& report, const Progress& progress) {
  std::vector<Eigen::Vector3f> normals;
  if (options.base_normals) normals = base_normals(*model.hierarchy, file.base_positions);
  const auto asset_of = [&](const MeasuredStream& payload) {
    return make_asset(payload, model.hierarchy->levels(), how.diagonal, normals,
                      options.input.stem().string());
  };
  MeasuredStream payload = cut_and_measure(file, options, 0, how, progress);
  if (options.target_size > 0)
    payload = cut_and_measure(
        file, options,
        payload_limit(asset_of(payload), {options.compress_base}, options.target_size), how,
        progress);
  report.payload_bytes = payload.file.bytes.size();
  report.payload_prefixes = payload.table.prefixes;
  return asset_of(payload);
}

void write_gltf(const std::filesystem::path& path, const gltf::ProgressiveAsset& asset,
                const ConvertOptions& options) {
  if (options.split)
    gltf::write_split(path, asset, {options.compress_base});
  else
    gltf::write_glb(path, asset, {options.compress_base});
}

// Encodes, measures and writes both outputs. All files are made and checked before one appears.
void write_outputs(const SurfaceModel& model, const analysis::WaveletDecomposition& wavelets,
                   double finest_step, const ConvertOptions& options, const PrefixMeasurement& how,
                   report::StageClock& clock, report::ConvertReport& report,
                   const Progress& progress) {
  std::optional<CheckedOutput> stream_output, gltf_output;
  if (!options.stream.empty()) {
    decode::StreamFile encoded = clock.run(
        "encode stream", [&] { return encode_model(model, wavelets, finest_step, true); });
    const MeasuredStream stream = clock.run("measure stream", [&] {
      return cut_and_measure(std::move(encoded), options, options.target_size, how, progress);
    });
    report.stream_bytes = stream.file.bytes.size();
    report.stream_prefixes = stream.table.prefixes;
    stream_output.emplace(options.stream, [&](const std::filesystem::path& path) {
      exporter::write_file_atomically(path, stream.file.bytes);
    });
  }
  if (!options.glb.empty()) {
    const decode::StreamFile encoded = clock.run(
        "encode payload", [&] { return encode_payload(model, wavelets, finest_step, options); });
    const gltf::ProgressiveAsset asset = clock.run("measure payload", [&] {
      return measure_asset(model, encoded, options, how, report, progress);
    });
    gltf_output.emplace(
        options.glb, [&](const std::filesystem::path& path) { write_gltf(path, asset, options); });
  }
  if (stream_output) stream_output->commit();
  if (gltf_output) gltf_output->commit();
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
  const SurfaceModel model = name_input_in_errors(options.input, [&] {
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
  const PrefixMeasurement how = measurement_of(original, model, options, report);
  report.remeshing_error = clock.run("measure remesh", [&] { return remeshing_error(model, how); });
  report.remesh_remark = report::explain_remeshing_error(report);
  const analysis::WaveletDecomposition wavelets = analyse_model(model, options, clock, progress);
  const auto local_details = analysis::local_details(*model.hierarchy, wavelets);
  report.level_details = level_details(local_details, report.diagonal);
  if (!options.debug_pictures.empty())
    clock.run("pictures", [&] {
      write_debug_pictures(options.debug_pictures, {cleaned, original, model, local_details, report},
                           options.threads, progress);
    });
  const double finest_step =
      report.diagonal *
      std::max(kStepPerRemeshingError * report.remeshing_error, kFinestRelativeStep);

  write_outputs(model, wavelets, finest_step, options, how, clock, report, progress);
  if (!options.glb.empty()) report.file_bytes = std::filesystem::file_size(options.glb);
  report.stages = clock.costs();
  return report;
}

}  // namespace zerotree::convert
