// Which wavelet transform a stream is made with.
#pragma once

#include "convert/convert.h"
#include "convert/model_encoding.h"
#include "convert/prefix_errors.h"
#include "mesh/progress.h"
#include "report/convert_report.h"
#include "report/stage_clock.h"
#include "surface/wavelet_transform.h"

namespace zerotree::convert {

/// As options, reports and `info` call it: "local" or "mirror".
const char* transform_name(surface::WaveletTransform transform);

/// The wavelets of `model` by the transform that the options name. If they leave the choice, both
/// are made, encoded and measured as `how` says, and the one is taken whose errors at 1/4, 1/2, ...
/// 8 bits per vertex have the smaller geometric mean. Notes in `report` what was taken and why.
AnalysedModel analyse_with_choice(SurfaceModel model, const ConvertOptions& options,
                                  const PrefixMeasurement& how, report::StageClock& clock,
                                  report::ConvertReport& report, const Progress& progress);

}  // namespace zerotree::convert
