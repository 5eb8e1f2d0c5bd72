// The graph of nodes.
#pragma once

#include <nlohmann/json.hpp>

#include "gltf/issue_table.h"

namespace zerotree::gltf {

/// Adds to `issues` what is wrong with the nodes and scenes of `core`, a checked document: nodes
/// with two parents, loops, scenes that list nodes other than roots, transforms that are none.
void check_scenes(const nlohmann::json& core, Issues& issues);

}  // namespace zerotree::gltf
