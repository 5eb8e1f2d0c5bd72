#include "convert/encoded_outputs.h"

#include <optional>
#include <utility>

#include "convert/base_grid.h"
#include "convert/measured_stream.h"
#include "convert/output_files.h"
#include "convert/refinable_stream.h"
#include "convert/stream_targets.h"
#include "export/atomic_file.h"
#include "gltf/progressive_writer.h"
#include "surface/surface_synthesis.h"

namespace zerotree::convert {
namespace {

// What both outputs are made of.
struct OutputSource {
  const AnalysedModel& analysed;
  const ConvertOptions& options;
  const PrefixMeasurement& how;
};

StreamTargets targets_of(const OutputSource& source) {
  const ConvertOptions& options = source.options;
  return {options.max_error_metres > 0 ? options.max_error_metres / source.how.diagonal
                                       : options.max_error,
          options.target_size};
}

RefinableStream refinable_stream(const OutputSource& source, double remeshing_error,
                                 StepEncoder encode) {
  return {std::move(encode), source.how.diagonal * default_step(remeshing_error),
          source.how.diagonal * kFinestRelativeStep, source.how};
}

// For glTF: bound to the base of the accessors, which lies on a grid if it is to be compressed.
StepEncoder payload_encoder(const OutputSource& source) {
  if (!source.options.compress_base)
    return [&source](double step) {
      return encode_model(source.analysed.model, source.analysed.wavelets, step, false);
    };
  const gltf::Placement grid = grid_for(source.analysed.wavelets.base_control_points);
  return [&source, grid, wavelets = on_grid(source.analysed.wavelets, grid)](double step) {
    decode::StreamFile file =
        encode_model(source.analysed.model, wavelets, step / grid.scale, false);
    file.placement = grid;
    return file;
  };
}

// Limit normals of the base: what an unaware viewer shades the base with.
std::vector<Eigen::Vector3f> base_normals(const surface::SubdivisionHierarchy& hierarchy,
                                          const surface::Positions& base_positions) {
  const surface::SubdivisionLevel& base = hierarchy.level(0);
  std::vector<Eigen::Vector3f> normals(base.vertex_count);
  surface::limit_surface(base, base_positions, {}, {normals.data(), sizeof(Eigen::Vector3f)});
  return normals;
}

gltf::ProgressiveAsset asset_of(const OutputSource& source, const MeasuredStream& payload) {
  const surface::SubdivisionHierarchy& hierarchy = *source.analysed.model.hierarchy;
  std::vector<Eigen::Vector3f> normals;
  if (source.options.base_normals) normals = base_normals(hierarchy, payload.file.base_positions);
  return make_asset(payload, hierarchy.levels(), source.how.diagonal, normals,
                    source.options.input.stem().string());
}

std::uint64_t gltf_size(const OutputSource& source, const gltf::ProgressiveAsset& asset) {
  const gltf::WriteOptions how{source.options.compress_base};
  return source.options.split ? gltf::split_size(source.options.glb, asset, how)
                              : gltf::glb_bytes(asset, how).size();
}

void write_gltf(const std::filesystem::path& path, const gltf::ProgressiveAsset& asset,
                const ConvertOptions& options) {
  if (options.split)
    gltf::write_split(path, asset, {options.compress_base});
  else
    gltf::write_glb(path, asset, {options.compress_base});
}

void make_stream(const OutputSource& source, std::optional<CheckedOutput>& output,
                 report::StageClock& clock, report::ConvertReport& report,
                 const Progress& progress) {
  RefinableStream encoded = clock.run("encode stream", [&] {
    return refinable_stream(source, report.remeshing_error, [&source](double step) {
      return encode_model(source.analysed.model, source.analysed.wavelets, step, true);
    });
  });
  const MeasuredStream stream = clock.run("measure stream", [&] {
    return meet_targets(
        encoded, targets_of(source), [](const MeasuredStream& s) { return s.file.bytes.size(); },
        report.remeshing_error, report.stream_targets, progress);
  });
  report.stream_bytes = stream.file.bytes.size();
  report.stream_prefixes = stream.table.prefixes;
  output.emplace(source.options.stream, [&](const std::filesystem::path& path) {
    exporter::write_file_atomically(path, stream.file.bytes);
  });
}

void make_gltf(const OutputSource& source, std::optional<CheckedOutput>& output,
               report::StageClock& clock, report::ConvertReport& report, const Progress& progress) {
  RefinableStream encoded = clock.run("encode payload", [&] {
    return refinable_stream(source, report.remeshing_error, payload_encoder(source));
  });
  const MeasuredStream payload = clock.run("measure payload", [&] {
    return meet_targets(
        encoded, targets_of(source),
        [&](const MeasuredStream& s) { return gltf_size(source, asset_of(source, s)); },
        report.remeshing_error, report.payload_targets, progress);
  });
  report.payload_bytes = payload.file.bytes.size();
  report.payload_prefixes = payload.table.prefixes;
  const gltf::ProgressiveAsset asset = asset_of(source, payload);
  output.emplace(source.options.glb, [&](const std::filesystem::path& path) {
    write_gltf(path, asset, source.options);
  });
}

}  // namespace

void write_outputs(const AnalysedModel& analysed, const ConvertOptions& options,
                   const PrefixMeasurement& how, report::StageClock& clock,
                   report::ConvertReport& report, const Progress& progress) {
  const OutputSource source{analysed, options, how};
  std::optional<CheckedOutput> stream_output, gltf_output;
  if (!options.stream.empty()) make_stream(source, stream_output, clock, report, progress);
  if (!options.glb.empty()) make_gltf(source, gltf_output, clock, report, progress);
  if (stream_output) stream_output->commit();
  if (gltf_output) gltf_output->commit();
}

}  // namespace zerotree::convert
