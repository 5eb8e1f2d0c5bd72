// Is the glTF document around the extension right? All defects, not only the first.
#pragma once

#include "gltf/gltf_document.h"
#include "gltf/issue_table.h"

namespace zerotree::gltf {

/// Adds to `issues` what is wrong with the parts of the document that the extension relies on:
/// asset, extension lists, scenes, nodes, meshes, accessors and their data, bufferViews, buffers.
/// Codes and pointers are glTF-Validator's. Each issue comes once. Any document is safe: takes time
/// and memory linear in the sizes of the file and of the files its buffers name.
void check_structure(GltfDocument& document, Issues& issues);

}  // namespace zerotree::gltf
