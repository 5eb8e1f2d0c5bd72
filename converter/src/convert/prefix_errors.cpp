#include "convert/prefix_errors.h"

#include <algorithm>
#include <limits>

namespace zerotree::convert {
namespace {

Eigen::AlignedBox3f box_of(const exporter::Surface& surface) {
  Eigen::AlignedBox3f box;
  for (const Eigen::Vector3f& p : surface.positions) box.extend(p);
  return box;
}

}  // namespace

PrefixErrors::PrefixErrors(const decode::StreamFile& stream, const PrefixMeasurement& how)
    : stream_(stream), how_(how) {}

decode::PrefixSurface& PrefixErrors::decoded(std::uint64_t bytes) {
  if (prefix_ == nullptr || bytes < decoded_bytes_)
    prefix_ = std::make_unique<decode::PrefixSurface>(stream_, how_.hierarchy);
  prefix_->advance_to(bytes);
  decoded_bytes_ = bytes;
  return *prefix_;
}

const std::optional<MeasuredSurface>& PrefixErrors::at(std::uint64_t bytes, Precision precision) {
  const auto [entry, is_new] = known_.try_emplace({bytes, precision});
  if (!is_new) return entry->second;
  decode::PrefixSurface& prefix = decoded(bytes);
  if (!prefix.has_surface()) return entry->second;
  measure::DistanceOptions options = how_.distance;
  if (precision == Precision::exact) options.samples = how_.exact_samples;
  const exporter::Surface surface = prefix.surface();
  const measure::SurfaceDistance distance =
      measure::compare_surfaces(how_.original, decode::to_triangle_mesh(surface), options);
  const double bits = 8.0 * static_cast<double>(bytes);
  entry->second = {{bytes, bits / static_cast<double>(how_.original_vertices),
                    distance.relative_rms(), distance.relative_hausdorff()},
                   box_of(surface)};
  return entry->second;
}

double PrefixErrors::error(std::uint64_t bytes, Precision precision) {
  const std::optional<MeasuredSurface>& measured = at(bytes, precision);
  return measured ? measured->error.error : std::numeric_limits<double>::infinity();
}

Eigen::AlignedBox3f PrefixErrors::box_before(std::uint64_t bytes) {
  Eigen::AlignedBox3f box;
  for (std::uint64_t length = 0; length < bytes; length = std::max<std::uint64_t>(2 * length, 1)) {
    decode::PrefixSurface& prefix = decoded(length);
    if (prefix.has_surface()) box.extend(box_of(prefix.surface()));
  }
  return box;
}

std::uint64_t PrefixErrors::shortest_with_surface() {
  std::uint64_t low = 0, high = stream_bytes();
  while (low < high) {
    const std::uint64_t middle = low + (high - low) / 2;
    if (decoded(middle).has_surface())
      high = middle;
    else
      low = middle + 1;
  }
  return high;
}

}  // namespace zerotree::convert
