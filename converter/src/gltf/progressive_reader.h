// From a glTF file to the progressive meshes in it.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "gltf/gltf_document.h"
#include "gltf/issue_table.h"
#include "gltf/progressive_asset.h"

namespace zerotree::gltf {

/// Reads the one progressive mesh of a .glb or .gltf file. A file that was cut off inside the
/// payload is read as far as it goes: payload.size() < payload_length then. Throws
/// Error(unreadable_input) naming the file, the place in its JSON and what to do.
ProgressiveAsset read_progressive(const std::filesystem::path& path);

/// Indices of the meshes that have the extension; reports what is wrong with its use in the
/// document as a whole (extensionsUsed, extensionsRequired, places without meaning).
std::vector<std::size_t> progressive_meshes(const GltfDocument& document, Issues& issues);

/// Where the first node that shows each mesh puts it. Throws IssueFound if a node is not as glTF
/// has it. Linear in meshes and nodes.
std::vector<Placement> mesh_placements(const GltfDocument& document);

/// Reads mesh `mesh`, which has the extension, without its placement, and adds all that is wrong
/// with it to `issues`, each issue once; empty if an error leaves nothing to decode.
std::optional<ProgressiveAsset> read_mesh(GltfDocument& document, std::size_t mesh, Issues& issues);

}  // namespace zerotree::gltf
