// The files of extension-spec/conformance.
#pragma once

#include <map>
#include <string>

#include "conformance_cases.h"

namespace zerotree::conformance {

/// Path in the folder, with '/', to content.
using Folder = std::map<std::string, Bytes>;

/// All files. Deterministic. Throws std::runtime_error if a case is not what its table says.
Folder conformance_folder();

}  // namespace zerotree::conformance
