// Does the prefixes table tell the truth? Answered by measuring against the mesh that was encoded.
#pragma once

#include <filesystem>

#include "mesh/progress.h"
#include "validate/validate_options.h"
#include "validate/validation_report.h"

namespace zerotree::validate {

/// Measures the prefixes of the table of `path`, as a converter does, against `source` and adds to
/// `report`, which is that of the file so far, what was measured and what the table states wrongly.
/// The surface is where the mesh's node puts it. Of a table of more than 32 entries as many are
/// measured, evenly spread. A file with errors is not measured, and the report says so.
///
/// Sampling leaves the measured errors uncertain. An entry is understated only if its error exceeds
/// what it states by more than 3 % in a measurement of 50,000 samples and in one of a million.
///
/// Throws Error(usage) unless the file has one progressive mesh, with a table. Costs about a
/// quarter of a second a prefix and 150 bytes per triangle of its surface.
void check_source(const std::filesystem::path& path, const SourceScan& source,
                  const Progress& progress, ValidationReport& report);

}  // namespace zerotree::validate
