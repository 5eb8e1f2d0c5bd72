// The shortest prefix of a stream that is as exact as asked for.
#pragma once

#include <cstdint>

#include "convert/prefix_errors.h"
#include "mesh/progress.h"

namespace zerotree::convert {

/// Length of the shortest prefix found whose exact error is at most `max_error` (relative); that of
/// the whole stream must be. Errors fall nearly, not quite, monotonically with length, and quick
/// measurements find the place that exact ones then settle: the result is about 0.5 % longer than
/// the shortest there is. Cost: about 15 quick and 3 exact measurements.
std::uint64_t shortest_prefix(PrefixErrors& errors, double max_error, const Progress& progress);

}  // namespace zerotree::convert
