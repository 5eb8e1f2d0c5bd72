// Is this file right? Answered by reading it and decoding its payload fully.
#pragma once

#include <cstdint>
#include <filesystem>

#include "validate/validation_report.h"

namespace zerotree::validate {

struct ValidateOptions {
  /// Largest surface to decode, in vertices of the finest level; a reader's limit, not the
  /// format's.
  std::uint64_t max_vertices = std::uint64_t{1} << 24;
};

/// Validates a .glb, .gltf or .zt file, recognised by its content. What is wrong with it is in the
/// report; a glTF file without progressive meshes is right. Throws Error(unreadable_input) only if
/// the file itself cannot be read.
ValidationReport validate_file(const std::filesystem::path& path,
                               const ValidateOptions& options = {});

}  // namespace zerotree::validate
