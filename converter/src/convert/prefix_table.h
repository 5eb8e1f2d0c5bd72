// Errors of prefixes, measured by decoding real truncated streams.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <Eigen/Geometry>

#include "decode/stream_file.h"
#include "measure/surface_distance.h"
#include "mesh/progress.h"
#include "report/convert_report.h"
#include "surface/subdivision_hierarchy.h"

namespace zerotree::convert {

/// What prefixes are measured against, and how.
struct PrefixMeasurement {
  /// The original input, whose diagonal errors are relative to.
  const measure::SurfaceIndex& original;
  measure::DistanceOptions distance;
  /// Vertices of the original input: rates are bits per vertex of it.
  std::uint64_t original_vertices;
  /// Bounding box diagonal of the original.
  double diagonal;
  /// Topology of the base and its levels.
  std::shared_ptr<const surface::SubdivisionHierarchy> hierarchy;
};

/// The table of a stream, and a box around the surfaces of its prefixes: that of the prefixes in
/// the table, widened by a margin for those between them.
struct PrefixTable {
  std::vector<report::PrefixError> prefixes;
  Eigen::AlignedBox3f bounds;
};

/// Decodes and measures the prefixes of `stream` of 1/4, 1/2, ... 8 bits per vertex and the whole
/// of it. A prefix that ends before the base is known is left out.
PrefixTable measure_prefixes(const decode::StreamFile& stream, const PrefixMeasurement& how,
                             const Progress& progress);

/// Length of the shortest prefix found by bisection whose measured error is at most `max_error`
/// (relative). Throws Error(target_not_reachable) if that of the whole stream is larger.
std::uint64_t shortest_prefix(const decode::StreamFile& stream, double max_error,
                              const PrefixMeasurement& how, const Progress& progress);

}  // namespace zerotree::convert
