// Streams cut to the error or the size that was asked for.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "convert/measured_stream.h"
#include "convert/refinable_stream.h"
#include "mesh/progress.h"
#include "report/convert_report.h"

namespace zerotree::convert {

/// What a stream has to meet; 0: no such target.
struct StreamTargets {
  /// Relative to the diagonal.
  double max_error = 0;
  /// Of what is written, in bytes.
  std::uint64_t size = 0;
};

/// Bytes of what is written for a stream.
using WrittenSize = std::function<std::uint64_t(const MeasuredStream&)>;

/// Cuts `stream` to the targets, having encoded it with finer steps where they ask for more than it
/// holds, measures the prefixes, and notes in `report` what was reached:
/// - an error: the shortest prefix whose exact error is at most that;
/// - a size: the longest prefix with which the written size is at most that;
/// - both: as for the error, and the size must hold.
/// Throws Error(target_not_reachable), naming what can be reached, if the error is below that of
/// the remesh (`remeshing_error`, relative), the size does not hold the base mesh, or the targets
/// exclude each other. A size that even the finest stream does not fill is noted, not refused.
MeasuredStream meet_targets(RefinableStream& stream, const StreamTargets& targets,
                            const WrittenSize& written_size, double remeshing_error,
                            report::ReachedTargets& report, const Progress& progress);

}  // namespace zerotree::convert
