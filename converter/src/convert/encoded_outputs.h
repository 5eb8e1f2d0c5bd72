// From wavelets to the files that were asked for.
#pragma once

#include "convert/convert.h"
#include "convert/model_encoding.h"
#include "convert/prefix_errors.h"
#include "mesh/progress.h"
#include "report/convert_report.h"
#include "report/stage_clock.h"

namespace zerotree::convert {

/// Encodes `analysed`, cuts to the targets, measures and writes the elementary stream and the glTF
/// file, and notes them in `report`, whose remeshing error says how fine a stream is by default.
/// All files are made and checked before one appears. Throws Error.
void write_outputs(const AnalysedModel& analysed, const ConvertOptions& options,
                   const PrefixMeasurement& how, report::StageClock& clock,
                   report::ConvertReport& report, const Progress& progress);

}  // namespace zerotree::convert
