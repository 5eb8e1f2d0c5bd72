// The geometry of one glTF primitive, in the space of its mesh.
#pragma once

#include <string>
#include <vector>

#include "import/gltf_accessors.h"
#include "import/polygon_mesh.h"

namespace zerotree::importer {

struct GltfPrimitive {
  /// Three per vertex.
  std::vector<double> positions;
  /// NORMAL, TEXCOORD_n, COLOR_n (always four components).
  std::vector<VertexAttribute> attributes;
  /// Names of the other attributes, which are not read.
  std::vector<std::string> unread_attributes;
  /// Vertices of the triangles, three each; strips and fans are resolved.
  std::vector<std::uint32_t> triangles;
};

/// Whether the primitive draws triangles, strips or fans.
bool draws_triangles(const tinygltf::Primitive& primitive);

/// Reads a primitive that draws triangles, Draco-compressed or not. `place` names file, mesh and
/// primitive in messages. Throws Error(unreadable_input).
GltfPrimitive read_gltf_primitive(const tinygltf::Primitive& primitive, GltfAccessors& accessors,
                                  const ImportOptions& options, const std::string& place);

}  // namespace zerotree::importer
