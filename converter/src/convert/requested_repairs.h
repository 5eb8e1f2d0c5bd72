// Changes of the surface that are made only if they are asked for.
#pragma once

#include "convert/convert.h"
#include "mesh/triangle_mesh.h"
#include "report/convert_report.h"
#include "report/stage_clock.h"

namespace zerotree::convert {

/// Fills holes and removes handles of the clean `mesh` as `options` say, and notes in `report` what
/// was done and what topology is left. Returns whether anything changed.
bool make_requested_repairs(TriangleMesh& mesh, const ConvertOptions& options,
                            report::StageClock& clock, report::ConvertReport& report,
                            const Progress& progress);

}  // namespace zerotree::convert
