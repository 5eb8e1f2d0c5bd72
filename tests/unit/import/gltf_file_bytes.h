// glTF files made in memory: views and accessors over one binary buffer.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "mesh/triangle_mesh.h"

namespace zerotree::test {

/// A glTF document under construction. Indices returned are the document's.
struct GltfDraft {
  nlohmann::json document;
  std::string binary;

  GltfDraft();
  int add_view(const std::string& bytes, std::size_t stride = 0);
  int add_accessor(int view, int component_type, std::size_t count, const char* type,
                   bool normalized = false);
  /// Float positions of `mesh`.
  int add_positions(const TriangleMesh& mesh);
  /// 16-bit indices.
  int add_indices(const std::vector<std::uint32_t>& indices);
  /// A mesh of one primitive and a node that holds it, in the scene.
  void add_mesh(const nlohmann::json& primitive, const nlohmann::json& node = {});

  /// The document as GLB, `binary` being its buffer 0.
  std::string glb() const;
  /// The document as JSON whose buffer is the file `uri`.
  std::string json_with_buffer(const std::string& uri) const;
};

std::vector<std::uint32_t> flat_indices(const TriangleMesh& mesh);
/// An indexed mesh of float positions.
GltfDraft plain_draft(const TriangleMesh& mesh);
/// The same under KHR_draco_mesh_compression.
GltfDraft draco_draft(const TriangleMesh& mesh);
/// The same under EXT_meshopt_compression, with a fallback buffer that has no bytes.
GltfDraft meshopt_draft(const TriangleMesh& mesh);

}  // namespace zerotree::test
