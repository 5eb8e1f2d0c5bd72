// The table of a stream's prefixes: how far the surface of each lies from the original.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "convert/prefix_errors.h"
#include "mesh/progress.h"
#include "report/convert_report.h"

namespace zerotree::convert {

/// The table of a stream, and a box around the surfaces of its prefixes: that of the prefixes in
/// the table, widened by a margin for those between them.
struct PrefixTable {
  std::vector<report::PrefixError> prefixes;
  Eigen::AlignedBox3f bounds;
};

/// The lengths a table has for a stream of `stream_bytes` bytes: those of 1/4, 1/2, ... 8 bits per
/// vertex that are shorter, and the whole.
std::vector<std::uint64_t> table_lengths(std::uint64_t stream_bytes, std::uint64_t vertices);

/// The table of the first `stream_bytes` bytes of a stream. The last entry, which is what the file
/// reaches, is as exact as `last`. A prefix that ends before the base is known is left out.
PrefixTable measure_prefixes(PrefixErrors& errors, std::uint64_t stream_bytes, Precision last,
                             const Progress& progress);

}  // namespace zerotree::convert
