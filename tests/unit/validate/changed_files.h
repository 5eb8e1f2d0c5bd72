// Right files that a test changes, and what the validator says of them.
#pragma once

#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "gltf/progressive_asset.h"
#include "validate/file_validation.h"

namespace zerotree::test {

/// The GLB file of `asset` with its JSON changed.
std::vector<std::uint8_t> with_json(const gltf::ProgressiveAsset& asset,
                                    const std::function<void(nlohmann::json&)>& change);
/// The same for an asset that is right.
std::vector<std::uint8_t> with_json(const std::function<void(nlohmann::json&)>& change);

/// The extension object of the first mesh.
nlohmann::json& extension(nlohmann::json& root);

/// Codes of all issues, in their order.
std::vector<std::string> codes(const validate::ValidationReport& report);
/// The first issue with this code; one without pointer and detail if there is none.
gltf::Issue issue_with(const validate::ValidationReport& report, const std::string& code);

/// The report of a file with these bytes.
validate::ValidationReport validate_bytes(std::span<const std::uint8_t> bytes,
                                          const std::string& name = "a.glb",
                                          const validate::ValidateOptions& options = {});

}  // namespace zerotree::test
