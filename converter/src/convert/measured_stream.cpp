#include "convert/measured_stream.h"

#include <algorithm>
#include <string>
#include <utility>

#include "convert/short_decimal.h"
#include "mesh/error.h"

namespace zerotree::convert {
namespace {

constexpr int kErrorDigits = 3;
constexpr int kMostErrorDigits = 7;
// Of the diagonal: how far rounding may move a side of the bounds.
constexpr double kBoundsStep = 0.002;

double relative_max_error(const ConvertOptions& options, double diagonal) {
  return options.max_error_metres > 0 ? options.max_error_metres / diagonal : options.max_error;
}

// Three digits say all that measuring by samples knows, but the file must not state a larger error
// than the one that was asked for and reached.
double short_error(double error, double asked) {
  if (!(error > 0)) return error;
  for (int digits = kErrorDigits; digits < kMostErrorDigits; ++digits) {
    const double rounded = rounded_up(error, digits);
    if (error > asked || rounded <= asked) return rounded;
  }
  return error;
}

void set_bounds(const Eigen::AlignedBox3f& box, const gltf::Placement& placement,
                gltf::ProgressiveAsset& asset) {
  const double step = kBoundsStep * asset.source_diagonal;
  const auto on_mesh = [&](const Eigen::Vector3f& corner) -> Eigen::Vector3d {
    return (corner.cast<double>() - placement.translation) / placement.scale;
  };
  const Eigen::Vector3d low = on_mesh(box.min()), high = on_mesh(box.max());
  for (int axis = 0; axis < 3; ++axis) {
    asset.bounds_min[axis] = static_cast<float>(rounded_down(low[axis], step));
    asset.bounds_max[axis] = static_cast<float>(rounded_up_by_step(high[axis], step));
  }
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
  return {std::move(file), std::move(table), max_error};
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
  asset.placement = payload.file.placement;
  asset.source_diagonal = diagonal / asset.placement.scale;
  std::vector<gltf::PrefixEntry> entries;
  for (const report::PrefixError& prefix : payload.table.prefixes)
    entries.push_back({prefix.bytes, short_error(prefix.error * asset.source_diagonal,
                                                 payload.asked_error * asset.source_diagonal)});
  asset.prefixes = gltf::monotone_prefixes(std::move(entries));
  set_bounds(payload.table.bounds, asset.placement, asset);
  return asset;
}

std::uint64_t payload_limit(const gltf::ProgressiveAsset& asset, const gltf::WriteOptions& how,
                            std::uint64_t file_size) {
  const std::uint64_t overhead = gltf::glb_bytes(asset, how).size() - asset.payload.size();
  if (overhead >= file_size)
    throw Error(ExitCode::target_not_reachable,
                "--target-size: the base mesh alone makes a file of " + std::to_string(overhead) +
                    " bytes: allow more, or ask for fewer --base-vertices");
  return file_size - overhead;
}

}  // namespace zerotree::convert
