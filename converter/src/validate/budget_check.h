// What an asset costs, compared with what it may cost.
#pragma once

#include <cstdint>

#include "gltf/gltf_document.h"
#include "validate/validate_options.h"
#include "validate/validation_report.h"

namespace zerotree::validate {

/// Bytes of a glTF file of `file_bytes` bytes and of all files that its buffers and images name,
/// each counted once. A file whose size cannot be told is added to `issues`.
std::uint64_t count_bytes(const gltf::GltfDocument& document, std::uint64_t file_bytes,
                          gltf::Issues& issues);

/// Compares the figures in `report` with `budgets` and adds what is beyond to its issues.
void check_budgets(const Budgets& budgets, ValidationReport& report);

}  // namespace zerotree::validate
