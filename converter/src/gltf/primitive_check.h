// How the primitives of meshes use their accessors.
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "gltf/accessor_check.h"

namespace zerotree::gltf {

/// Adds to `issues` what is wrong with the primitives of `core`, a checked document whose accessors
/// are `accessors`: names, forms and counts of attributes, indices out of range, bufferViews and
/// accessors that serve two purposes.
void check_primitives(const nlohmann::json& core, const std::vector<LinkedAccessor>& accessors,
                      Issues& issues);

}  // namespace zerotree::gltf
