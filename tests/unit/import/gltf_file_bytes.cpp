#include "gltf_file_bytes.h"

#include <meshoptimizer.h>

#include "mesh_file_bytes.h"

namespace zerotree::test {
namespace {

using nlohmann::json;

constexpr int float_type = 5126, unsigned_short_type = 5123;

std::string position_bytes(const TriangleMesh& mesh) {
  std::string bytes;
  for (const Eigen::Vector3d& p : mesh.positions)
    for (int i = 0; i < 3; ++i) append_bytes(bytes, static_cast<float>(p[i]));
  return bytes;
}

// A compressed view: its place in the fallback buffer, and what is compressed in buffer 0.
int add_meshopt_view(GltfDraft& draft, const std::vector<unsigned char>& packed, std::size_t offset,
                     std::size_t count, std::size_t stride, const char* mode) {
  while (draft.binary.size() % 4 != 0) draft.binary += '\0';
  json view = {{"buffer", 1}, {"byteOffset", offset}, {"byteLength", count * stride}};
  if (std::string(mode) == "ATTRIBUTES") view["byteStride"] = stride;
  view["extensions"]["EXT_meshopt_compression"] = {{"buffer", 0},
                                                   {"byteOffset", draft.binary.size()},
                                                   {"byteLength", packed.size()},
                                                   {"count", count},
                                                   {"byteStride", stride},
                                                   {"mode", mode}};
  draft.binary.append(packed.begin(), packed.end());
  draft.document["bufferViews"].push_back(view);
  return static_cast<int>(draft.document["bufferViews"].size()) - 1;
}

}  // namespace

GltfDraft::GltfDraft() {
  document["asset"]["version"] = "2.0";
  document["scene"] = 0;
  document["scenes"] = json::array({json{{"nodes", json::array()}}});
}

int GltfDraft::add_view(const std::string& bytes, std::size_t stride) {
  while (binary.size() % 4 != 0) binary += '\0';
  json view = {{"buffer", 0}, {"byteOffset", binary.size()}, {"byteLength", bytes.size()}};
  if (stride != 0) view["byteStride"] = stride;
  binary += bytes;
  document["bufferViews"].push_back(view);
  return static_cast<int>(document["bufferViews"].size()) - 1;
}

int GltfDraft::add_accessor(int view, int component_type, std::size_t count, const char* type,
                            bool normalized) {
  json accessor = {{"componentType", component_type}, {"count", count}, {"type", type}};
  if (view >= 0) accessor["bufferView"] = view;
  if (normalized) accessor["normalized"] = true;
  document["accessors"].push_back(accessor);
  return static_cast<int>(document["accessors"].size()) - 1;
}

int GltfDraft::add_positions(const TriangleMesh& mesh) {
  return add_accessor(add_view(position_bytes(mesh)), float_type, mesh.positions.size(), "VEC3");
}

int GltfDraft::add_indices(const std::vector<std::uint32_t>& indices) {
  std::string bytes;
  for (std::uint32_t i : indices) append_bytes(bytes, static_cast<std::uint16_t>(i));
  return add_accessor(add_view(bytes), unsigned_short_type, indices.size(), "SCALAR");
}

void GltfDraft::add_mesh(const json& primitive, const json& node) {
  json made = node.is_null() ? json::object() : node;
  made["mesh"] = document["meshes"].size();
  document["meshes"].push_back({{"primitives", json::array({primitive})}});
  document["scenes"][0]["nodes"].push_back(document["nodes"].size());
  document["nodes"].push_back(made);
}

std::string GltfDraft::glb() const {
  json complete = document;
  std::string data = binary;
  while (data.size() % 4 != 0) data += '\0';
  if (!complete.contains("buffers")) complete["buffers"] = json::array({json::object()});
  complete["buffers"][0]["byteLength"] = data.size();
  std::string text = complete.dump();
  while (text.size() % 4 != 0) text += ' ';
  std::string bytes = "glTF";
  append_bytes(bytes, std::uint32_t{2});
  append_bytes(bytes, static_cast<std::uint32_t>(28 + text.size() + data.size()));
  append_bytes(bytes, static_cast<std::uint32_t>(text.size()));
  bytes += "JSON" + text;
  append_bytes(bytes, static_cast<std::uint32_t>(data.size()));
  return bytes + std::string("BIN\0", 4) + data;
}

std::string GltfDraft::json_with_buffer(const std::string& uri) const {
  json complete = document;
  complete["buffers"] = json::array({json{{"byteLength", binary.size()}, {"uri", uri}}});
  return complete.dump();
}

std::vector<std::uint32_t> flat_indices(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> indices;
  for (const Triangle& t : mesh.triangles) indices.insert(indices.end(), t.begin(), t.end());
  return indices;
}

GltfDraft plain_draft(const TriangleMesh& mesh) {
  GltfDraft draft;
  const int positions = draft.add_positions(mesh);
  const int indices = draft.add_indices(flat_indices(mesh));
  draft.add_mesh({{"attributes", {{"POSITION", positions}}}, {"indices", indices}});
  return draft;
}

GltfDraft draco_draft(const TriangleMesh& mesh) {
  GltfDraft draft;
  const int view = draft.add_view(draco_bytes(mesh));
  const int positions = draft.add_accessor(-1, float_type, mesh.positions.size(), "VEC3");
  const int indices =
      draft.add_accessor(-1, unsigned_short_type, mesh.triangles.size() * 3, "SCALAR");
  json primitive = {{"attributes", {{"POSITION", positions}}}, {"indices", indices}};
  primitive["extensions"]["KHR_draco_mesh_compression"] = {{"bufferView", view},
                                                           {"attributes", {{"POSITION", 0}}}};
  draft.add_mesh(primitive);
  draft.document["extensionsUsed"] = {"KHR_draco_mesh_compression"};
  draft.document["extensionsRequired"] = {"KHR_draco_mesh_compression"};
  return draft;
}

GltfDraft meshopt_draft(const TriangleMesh& mesh) {
  GltfDraft draft;
  const std::size_t vertices = mesh.positions.size();
  const std::string positions = position_bytes(mesh);
  std::vector<unsigned char> packed(meshopt_encodeVertexBufferBound(vertices, 12));
  packed.resize(
      meshopt_encodeVertexBuffer(packed.data(), packed.size(), positions.data(), vertices, 12));
  const int position_view = add_meshopt_view(draft, packed, 0, vertices, 12, "ATTRIBUTES");

  std::vector<std::uint32_t> indices = flat_indices(mesh);
  packed.resize(meshopt_encodeIndexBufferBound(indices.size(), vertices));
  packed.resize(
      meshopt_encodeIndexBuffer(packed.data(), packed.size(), indices.data(), indices.size()));
  const int index_view =
      add_meshopt_view(draft, packed, positions.size(), indices.size(), 2, "TRIANGLES");

  const std::size_t fallback = positions.size() + indices.size() * 2;
  draft.document["buffers"] = json::array({json::object(), json{{"byteLength", fallback}}});
  draft.document["buffers"][1]["extensions"]["EXT_meshopt_compression"]["fallback"] = true;
  draft.document["extensionsRequired"] = {"EXT_meshopt_compression"};
  draft.add_mesh(
      {{"attributes",
        {{"POSITION", draft.add_accessor(position_view, float_type, vertices, "VEC3")}}},
       {"indices", draft.add_accessor(index_view, unsigned_short_type, indices.size(), "SCALAR")}});
  return draft;
}

}  // namespace zerotree::test
