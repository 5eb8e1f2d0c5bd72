// Is this file right? Answered by reading it and decoding its payload fully.
#pragma once

#include <filesystem>
#include <string>

#include "mesh/progress.h"
#include "validate/validate_options.h"
#include "validate/validation_report.h"

namespace zerotree::validate {

/// Validates a .glb, .gltf or .zt file, recognised by its content. What is wrong with it is in the
/// report; a glTF file without progressive meshes is right. Throws Error(unreadable_input) only if
/// the file itself cannot be read, and Error(usage) if it is to be measured against a source but
/// is not of the kind that can be.
ValidationReport validate_file(const std::filesystem::path& path,
                               const ValidateOptions& options = {}, const Progress& progress = {});

/// The report of a file that could not be read for the reason `why`.
ValidationReport unreadable_report(const std::filesystem::path& path, const std::string& why);

}  // namespace zerotree::validate
