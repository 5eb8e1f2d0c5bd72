// From wavelets to the files that were asked for.
#pragma once

#include "analysis/wavelet_decomposition.h"
#include "convert/convert.h"
#include "convert/prefix_errors.h"
#include "convert/surface_model.h"
#include "mesh/progress.h"
#include "report/convert_report.h"
#include "report/stage_clock.h"

namespace zerotree::convert {

/// Encodes `wavelets`, cuts to the targets, measures and writes the elementary stream and the glTF
/// file, and notes them in `report`, whose remeshing error says how fine a stream is by default.
/// All files are made and checked before one appears. Throws Error.
void write_outputs(const SurfaceModel& model, const analysis::WaveletDecomposition& wavelets,
                   const ConvertOptions& options, const PrefixMeasurement& how,
                   report::StageClock& clock, report::ConvertReport& report,
                   const Progress& progress);

}  // namespace zerotree::convert
