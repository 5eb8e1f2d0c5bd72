#include "export/mesh_bytes.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <bit>
#include <cctype>
#include <charconv>
#include <cstring>
#include <sstream>

#include "mesh/error.h"

namespace zerotree::exporter {
namespace {

static_assert(std::endian::native == std::endian::little, "PLY and GLB are written as they lie");
static_assert(sizeof(Eigen::Vector3f) == 12 && sizeof(Triangle) == 12);

void append_text(std::vector<std::uint8_t>& bytes, std::string_view text) {
  bytes.insert(bytes.end(), text.begin(), text.end());
}

void append_raw(std::vector<std::uint8_t>& bytes, const void* data, std::size_t size) {
  const auto* first = static_cast<const std::uint8_t*>(data);
  bytes.insert(bytes.end(), first, first + size);
}

void append_number(std::vector<std::uint8_t>& bytes, float value) {
  char text[32];
  const auto result = std::to_chars(text, text + sizeof text, value);
  append_text(bytes, std::string_view(text, static_cast<std::size_t>(result.ptr - text)));
}

void append_vector_line(std::vector<std::uint8_t>& bytes, std::string_view keyword,
                        const Eigen::Vector3f& v) {
  append_text(bytes, keyword);
  for (int k = 0; k < 3; ++k) {
    bytes.push_back(' ');
    append_number(bytes, v[k]);
  }
  bytes.push_back('\n');
}

// A buffer view over the end of the buffer and its accessor; returns the accessor's index.
int add_accessor(tinygltf::Model& model, const void* data, std::size_t size, int target,
                 int component_type, int type, std::size_t count) {
  std::vector<unsigned char>& buffer = model.buffers[0].data;
  tinygltf::BufferView view;
  view.buffer = 0;
  view.byteOffset = buffer.size();
  view.byteLength = size;
  view.target = target;
  append_raw(buffer, data, size);
  model.bufferViews.push_back(view);
  tinygltf::Accessor accessor;
  accessor.bufferView = static_cast<int>(model.bufferViews.size()) - 1;
  accessor.componentType = component_type;
  accessor.type = type;
  accessor.count = count;
  model.accessors.push_back(accessor);
  return static_cast<int>(model.accessors.size()) - 1;
}

int add_positions(tinygltf::Model& model, const std::vector<Eigen::Vector3f>& positions) {
  const int index =
      add_accessor(model, positions.data(), positions.size() * 12, TINYGLTF_TARGET_ARRAY_BUFFER,
                   TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3, positions.size());
  Eigen::Vector3f low = positions.front(), high = positions.front();
  for (const Eigen::Vector3f& p : positions) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  tinygltf::Accessor& accessor = model.accessors[static_cast<std::size_t>(index)];
  accessor.minValues = {low.x(), low.y(), low.z()};
  accessor.maxValues = {high.x(), high.y(), high.z()};
  return index;
}

tinygltf::Model gltf_model(const Surface& surface) {
  tinygltf::Model model;
  model.asset.version = "2.0";
  model.asset.generator = "zerotree";
  model.buffers.emplace_back();
  tinygltf::Primitive primitive;
  primitive.mode = TINYGLTF_MODE_TRIANGLES;
  primitive.attributes["POSITION"] = add_positions(model, surface.positions);
  if (!surface.normals.empty())
    primitive.attributes["NORMAL"] = add_accessor(
        model, surface.normals.data(), surface.normals.size() * 12, TINYGLTF_TARGET_ARRAY_BUFFER,
        TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3, surface.normals.size());
  primitive.indices =
      add_accessor(model, surface.triangles.data(), surface.triangles.size() * 12,
                   TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT,
                   TINYGLTF_TYPE_SCALAR, surface.triangles.size() * 3);
  model.meshes.emplace_back();
  model.meshes[0].primitives.push_back(primitive);
  model.nodes.emplace_back();
  model.nodes[0].mesh = 0;
  model.scenes.emplace_back();
  model.scenes[0].nodes = {0};
  model.defaultScene = 0;
  return model;
}

}  // namespace

std::vector<std::uint8_t> ply_bytes(const Surface& surface) {
  std::ostringstream header;
  header << "ply\nformat binary_little_endian 1.0\nelement vertex " << surface.positions.size()
         << "\nproperty float x\nproperty float y\nproperty float z\n";
  const bool has_normals = !surface.normals.empty();
  if (has_normals) header << "property float nx\nproperty float ny\nproperty float nz\n";
  header << "element face " << surface.triangles.size()
         << "\nproperty list uchar uint vertex_indices\nend_header\n";
  std::vector<std::uint8_t> bytes;
  bytes.reserve(header.str().size() + surface.positions.size() * 24 +
                surface.triangles.size() * 13);
  append_text(bytes, header.str());
  for (std::size_t v = 0; v < surface.positions.size(); ++v) {
    append_raw(bytes, surface.positions[v].data(), 12);
    if (has_normals) append_raw(bytes, surface.normals[v].data(), 12);
  }
  for (const Triangle& t : surface.triangles) {
    bytes.push_back(3);
    append_raw(bytes, t.data(), 12);
  }
  return bytes;
}

std::vector<std::uint8_t> obj_bytes(const Surface& surface) {
  std::vector<std::uint8_t> bytes;
  for (const Eigen::Vector3f& p : surface.positions) append_vector_line(bytes, "v", p);
  for (const Eigen::Vector3f& n : surface.normals) append_vector_line(bytes, "vn", n);
  for (const Triangle& t : surface.triangles) {
    append_text(bytes, "f");
    for (std::uint32_t v : t) {
      const std::string corner = std::to_string(std::uint64_t{v} + 1);
      append_text(bytes, " " + corner + (surface.normals.empty() ? "" : "//" + corner));
    }
    bytes.push_back('\n');
  }
  return bytes;
}

std::vector<std::uint8_t> glb_bytes(const Surface& surface) {
  if (surface.positions.empty() || surface.triangles.empty())
    throw Error(ExitCode::internal, "an empty surface cannot be written as GLB");
  const tinygltf::Model model = gltf_model(surface);
  std::ostringstream out;
  tinygltf::TinyGLTF writer;
  if (!writer.WriteGltfSceneToStream(&model, out, false, true))
    throw Error(ExitCode::internal, "tinygltf could not write the GLB");
  const std::string text = out.str();
  return {text.begin(), text.end()};
}

std::vector<std::uint8_t> mesh_bytes(const Surface& surface, std::string_view extension) {
  std::string lower(extension);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (lower == ".ply") return ply_bytes(surface);
  if (lower == ".obj") return obj_bytes(surface);
  if (lower == ".glb") return glb_bytes(surface);
  throw Error(ExitCode::usage,
              "cannot write \"" + lower + "\" files: name the output .ply, .obj or .glb");
}

}  // namespace zerotree::exporter
