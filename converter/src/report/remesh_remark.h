// Says why a remesh is farther from the input than the input's density would allow.
#pragma once

#include <string>

#include "report/convert_report.h"

namespace zerotree::report {

/// A sentence that names the likely cause if the remeshing error is more than three times the
/// discretisation error, and what to do; empty otherwise.
std::string explain_remeshing_error(const ConvertReport& report);

}  // namespace zerotree::report
