#include "convert/prefix_table.h"

#include <algorithm>
#include <cstdio>
#include <limits>
#include <string>

#include "decode/prefix_surface.h"
#include "mesh/error.h"

namespace zerotree::convert {
namespace {

// Bits per vertex, doubling from one to the other.
constexpr double kLowestRate = 1.0 / 4, kHighestRate = 8;
// Of the diagonal: prefixes between two of the table, and points of the limit surface between the
// vertices, may reach a little further.
constexpr double kBoundsMargin = 0.005;

std::vector<std::uint64_t> prefix_lengths(std::uint64_t stream_bytes, std::uint64_t vertices) {
  std::vector<std::uint64_t> lengths;
  for (double rate = kLowestRate; rate <= kHighestRate; rate *= 2) {
    const auto bytes = static_cast<std::uint64_t>(rate * static_cast<double>(vertices) / 8);
    if (bytes >= stream_bytes) break;
    if (bytes > 0 && (lengths.empty() || bytes > lengths.back())) lengths.push_back(bytes);
  }
  lengths.push_back(stream_bytes);
  return lengths;
}

report::PrefixError measure_surface(const exporter::Surface& surface, std::uint64_t bytes,
                                    const PrefixMeasurement& how) {
  const measure::SurfaceDistance distance =
      measure::compare_surfaces(how.original, decode::to_triangle_mesh(surface), how.distance);
  return {bytes, 8.0 * static_cast<double>(bytes) / static_cast<double>(how.original_vertices),
          distance.relative_rms(), distance.relative_hausdorff()};
}

void extend(Eigen::AlignedBox3f& box, const exporter::Surface& surface) {
  for (const Eigen::Vector3f& p : surface.positions) box.extend(p);
}

double prefix_error(const decode::StreamFile& stream, std::uint64_t bytes,
                    const PrefixMeasurement& how) {
  decode::PrefixSurface prefix(stream, how.hierarchy);
  prefix.advance_to(bytes);
  if (!prefix.has_surface()) return std::numeric_limits<double>::infinity();
  return measure_surface(prefix.surface(), bytes, how).error;
}

}  // namespace

PrefixTable measure_prefixes(const decode::StreamFile& stream, const PrefixMeasurement& how,
                             const Progress& progress) {
  PrefixTable table;
  decode::PrefixSurface prefix(stream, how.hierarchy);
  // An external base has a surface before the first byte.
  if (prefix.has_surface()) extend(table.bounds, prefix.surface());
  const auto lengths = prefix_lengths(stream.bytes.size(), how.original_vertices);
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    report_progress(progress, "measuring prefixes",
                    static_cast<double>(i) / static_cast<double>(lengths.size()));
    prefix.advance_to(lengths[i]);
    if (!prefix.has_surface()) continue;
    const exporter::Surface surface = prefix.surface();
    extend(table.bounds, surface);
    table.prefixes.push_back(measure_surface(surface, lengths[i], how));
  }
  const auto margin = static_cast<float>(kBoundsMargin * how.diagonal);
  table.bounds.min().array() -= margin;
  table.bounds.max().array() += margin;
  return table;
}

std::uint64_t shortest_prefix(const decode::StreamFile& stream, double max_error,
                              const PrefixMeasurement& how, const Progress& progress) {
  std::uint64_t too_short = 0, enough = stream.bytes.size();
  const double best = prefix_error(stream, enough, how);
  if (best > max_error) {
    char text[160];
    std::snprintf(text, sizeof text,
                  "an error of %.3g cannot be reached: the whole stream has %.3g; ask for a finer "
                  "remesh (--levels, --base-vertices) or a larger error",
                  max_error, best);
    throw Error(ExitCode::target_not_reachable, text);
  }
  for (int step = 0; enough - too_short > std::max<std::uint64_t>(1, enough / 200); ++step) {
    report_progress(progress, "searching the shortest prefix", std::min(1.0, step / 16.0));
    const std::uint64_t middle = too_short + (enough - too_short) / 2;
    (prefix_error(stream, middle, how) <= max_error ? enough : too_short) = middle;
  }
  return enough;
}

}  // namespace zerotree::convert
