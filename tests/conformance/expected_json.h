// What a prefix decodes to, as text.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "conformance_cases.h"

namespace zerotree::conformance {

/// {"positions": ..., "triangles": ...} of an external base.
std::string base_json(const Base& base);

/// The file NAME.BYTES.json of the first `bytes` bytes of a stream. Throws std::runtime_error if
/// our decoder calls it broken.
std::string expected_json(const StreamCase& stream, std::size_t bytes);

/// What our decoder complains of; throws std::runtime_error if it does not.
std::string complaint_about(const BrokenCase& broken);

}  // namespace zerotree::conformance
