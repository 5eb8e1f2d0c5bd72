#include "convert/measured_stream.h"

#include <utility>

#include "convert/short_decimal.h"
#include "gltf/progressive_writer.h"

namespace zerotree::convert {
namespace {

constexpr int kErrorDigits = 3;
constexpr int kMostErrorDigits = 7;
// Of the diagonal: how far rounding may move a side of the bounds.
constexpr double kBoundsStep = 0.002;

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

}  // namespace zerotree::convert
