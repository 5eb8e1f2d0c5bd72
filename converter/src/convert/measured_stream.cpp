#include "convert/measured_stream.h"

#include <algorithm>
#include <string>
#include <utility>

#include "gltf/progressive_writer.h"
#include "mesh/error.h"

namespace zerotree::convert {
namespace {

double relative_max_error(const ConvertOptions& options, double diagonal) {
  return options.max_error_metres > 0 ? options.max_error_metres / diagonal : options.max_error;
}

}  // namespace

MeasuredStream cut_and_measure(decode::StreamFile file, const ConvertOptions& options,
                               std::uint64_t size_limit, const PrefixMeasurement& how,
                               const Progress& progress) {
  const double max_error = relative_max_error(options, how.diagonal);
  if (max_error > 0) file.bytes.resize(shortest_prefix(file, max_error, how, progress));
  if (size_limit > 0 && file.bytes.size() > size_limit) {
    if (max_error > 0)
      throw Error(ExitCode::target_not_reachable,
                  "the error asked for takes " + std::to_string(file.bytes.size()) +
                      " bytes of stream, " + std::to_string(size_limit) +
                      " are allowed: raise --target-size or --max-error");
    file.bytes.resize(size_limit);
  }
  PrefixTable table = measure_prefixes(file, how, progress);
  if (table.prefixes.empty())
    throw Error(ExitCode::target_not_reachable,
                "--target-size: " + std::to_string(size_limit) +
                    " bytes do not even hold the base mesh: allow more, or ask for fewer "
                    "--base-vertices");
  return {std::move(file), std::move(table)};
}

gltf::ProgressiveAsset make_asset(const MeasuredStream& payload, int levels, double diagonal,
                                  const std::vector<Eigen::Vector3f>& normals,
                                  const std::string& name) {
  gltf::ProgressiveAsset asset;
  asset.name = name;
  asset.base = payload.file.base;
  asset.base.crease_edges.clear();
  asset.base.corner_vertices.clear();
  const std::vector<float>& xyz = payload.file.base_positions;
  for (std::size_t i = 0; i < xyz.size(); i += 3)
    asset.control_points.emplace_back(xyz[i], xyz[i + 1], xyz[i + 2]);
  asset.normals = normals;
  asset.payload = payload.file.bytes;
  asset.payload_length = asset.payload.size();
  asset.levels = levels;
  std::vector<gltf::PrefixEntry> entries;
  for (const report::PrefixError& prefix : payload.table.prefixes)
    entries.push_back({prefix.bytes, prefix.error * diagonal});
  asset.prefixes = gltf::monotone_prefixes(std::move(entries));
  asset.bounds_min = payload.table.bounds.min();
  asset.bounds_max = payload.table.bounds.max();
  asset.source_diagonal = diagonal;
  return asset;
}

std::uint64_t payload_limit(const gltf::ProgressiveAsset& asset, std::uint64_t file_size) {
  const std::uint64_t overhead = gltf::glb_bytes(asset).size() - asset.payload.size();
  if (overhead >= file_size)
    throw Error(ExitCode::target_not_reachable,
                "--target-size: the base mesh alone makes a file of " + std::to_string(overhead) +
                    " bytes: allow more, or ask for fewer --base-vertices");
  return file_size - overhead;
}

}  // namespace zerotree::convert
