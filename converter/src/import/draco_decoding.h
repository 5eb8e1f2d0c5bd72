// Draco's decoder behind the checks that a hostile stream needs.
#pragma once

#include <draco/mesh/mesh.h>

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "import/imported_mesh.h"

namespace zerotree::importer {

/// Decodes a Draco triangle mesh; afterwards every face names points below num_points().
/// `place` names the file, and the part of it, in messages. Throws Error(unreadable_input).
std::unique_ptr<draco::Mesh> decode_draco_mesh(std::string_view bytes, const ImportOptions& options,
                                               const std::string& place);

/// The first `components` values of `attribute` at `value`, into `out`; refuses an index that the
/// attribute does not hold.
void draco_values(const draco::PointAttribute& attribute, draco::AttributeValueIndex value,
                  int components, double* out, const std::string& place);

}  // namespace zerotree::importer
