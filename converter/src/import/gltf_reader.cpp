#include <tiny_gltf.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <set>

#include "import/gltf_accessors.h"
#include "import/gltf_primitives.h"
#include "import/import_error.h"
#include "import/mesh_readers.h"

namespace zerotree::importer {
namespace {

// Buffers are resolved already and images are not needed: tinygltf must not go and look for them.
// It also refuses indices that only the Draco stream holds.
nlohmann::json without_what_is_not_parsed(nlohmann::json document) {
  document.erase("buffers");
  document.erase("images");
  const auto meshes = document.find("meshes");
  if (meshes == document.end() || !meshes->is_array()) return document;
  for (nlohmann::json& mesh : *meshes) {
    if (!mesh.is_object() || !mesh.contains("primitives") || !mesh["primitives"].is_array())
      continue;
    for (nlohmann::json& primitive : mesh["primitives"])
      if (primitive.is_object() && primitive.contains("extensions") &&
          primitive["extensions"].contains("KHR_draco_mesh_compression"))
        primitive.erase("indices");
  }
  return document;
}

tinygltf::Model parse_model(const GltfContainer& container, const std::string& name) {
  const nlohmann::json document = without_what_is_not_parsed(container.document);
  const std::string text = document.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  tinygltf::TinyGLTF parser;
  tinygltf::Model model;
  std::string error, warning;
  if (!parser.LoadASCIIFromString(&model, &error, &warning, text.c_str(),
                                  static_cast<unsigned>(text.size()), ""))
    refuse(name, "the glTF cannot be read (" +
                     (error.empty() ? "no reason given" : error.substr(0, error.find('\n'))) +
                     "); export it again");
  return model;
}

void check_required_extensions(const tinygltf::Model& model, const std::string& name) {
  // What changes the geometry and is handled here, or does not change it at all.
  static const std::set<std::string> geometric = {
      "KHR_draco_mesh_compression", "EXT_meshopt_compression", "KHR_mesh_quantization"};
  for (const std::string& extension : model.extensionsRequired) {
    const bool appearance =
        extension.starts_with("KHR_materials_") || extension.starts_with("KHR_texture_") ||
        extension.starts_with("EXT_texture_") || extension == "KHR_lights_punctual";
    if (!appearance && !geometric.contains(extension))
      refuse(name, "requires glTF extension " + in_quotes(extension) +
                       ", which is not read; export the file without it");
  }
}

Eigen::Matrix4d local_transform(const tinygltf::Node& node) {
  if (node.matrix.size() == 16) return Eigen::Map<const Eigen::Matrix4d>(node.matrix.data());
  Eigen::Affine3d transform = Eigen::Affine3d::Identity();
  if (node.translation.size() == 3)
    transform.translate(Eigen::Map<const Eigen::Vector3d>(node.translation.data()));
  if (node.rotation.size() == 4) {
    Eigen::Quaterniond q(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]);
    q.normalize();
    transform.rotate(q);
  }
  if (node.scale.size() == 3) transform.scale(Eigen::Map<const Eigen::Vector3d>(node.scale.data()));
  return transform.matrix();
}

class SceneReader {
 public:
  SceneReader(const tinygltf::Model& model, const GltfContainer& container,
              const ImportOptions& options, const std::string& name)
      : model_(model),
        options_(options),
        name_(name),
        accessors_(model, container, options, name) {}

  PolygonMesh read() {
    std::vector<Visit> open;
    for (int root : roots()) open.push_back({root, Eigen::Matrix4d::Identity()});
    std::reverse(open.begin(), open.end());
    std::vector<bool> seen(model_.nodes.size(), false);
    while (!open.empty()) {
      const Visit visit = open.back();
      open.pop_back();
      if (visit.node < 0 || static_cast<std::size_t>(visit.node) >= model_.nodes.size())
        refuse(name_, "node " + std::to_string(visit.node) + " does not exist; export it again");
      const auto index = static_cast<std::size_t>(visit.node);
      // A node has one parent (glTF 2.0, 3.5.2); without this check a small file could unfold
      // into an endless tree.
      if (seen[index])
        refuse(name_, "node " + std::to_string(index) + " has two parents; export it again");
      seen[index] = true;
      const tinygltf::Node& node = model_.nodes[index];
      const Eigen::Matrix4d world = visit.parent * local_transform(node);
      if (node.mesh >= 0) add_mesh(node, world);
      for (auto child = node.children.rbegin(); child != node.children.rend(); ++child)
        open.push_back({*child, world});
    }
    note_the_rest();
    return std::move(mesh_);
  }

 private:
  struct Visit {
    int node;
    Eigen::Matrix4d parent;
  };

  std::vector<int> roots() const {
    const int scene = std::max(model_.defaultScene, 0);
    if (static_cast<std::size_t>(scene) < model_.scenes.size())
      return model_.scenes[static_cast<std::size_t>(scene)].nodes;
    std::vector<bool> is_child(model_.nodes.size(), false);
    for (const tinygltf::Node& node : model_.nodes)
      for (int child : node.children)
        if (child >= 0 && static_cast<std::size_t>(child) < is_child.size())
          is_child[static_cast<std::size_t>(child)] = true;
    std::vector<int> result;
    for (std::size_t n = 0; n < is_child.size(); ++n)
      if (!is_child[n]) result.push_back(static_cast<int>(n));
    return result;
  }

  void add_mesh(const tinygltf::Node& node, const Eigen::Matrix4d& world) {
    if (static_cast<std::size_t>(node.mesh) >= model_.meshes.size())
      refuse(name_, "mesh " + std::to_string(node.mesh) + " does not exist; export it again");
    read_meshes_.insert(node.mesh);
    if (node.skin >= 0)
      notes_.insert("Skins are not carried: the geometry is taken as it is stored, unposed.");
    const tinygltf::Mesh& mesh = model_.meshes[static_cast<std::size_t>(node.mesh)];
    for (std::size_t p = 0; p < mesh.primitives.size(); ++p) {
      const tinygltf::Primitive& primitive = mesh.primitives[p];
      if (!primitive.targets.empty()) notes_.insert("Morph targets are not carried.");
      if (!draws_triangles(primitive)) {
        notes_.insert("Primitives of points or lines are not carried.");
        continue;
      }
      const std::string place =
          name_ + ", mesh " + std::to_string(node.mesh) + ", primitive " + std::to_string(p);
      append(read_gltf_primitive(primitive, accessors_, options_, place), world);
    }
  }

  void append(const GltfPrimitive& primitive, const Eigen::Matrix4d& world) {
    const std::size_t first = mesh_.positions.size(), added = primitive.positions.size() / 3;
    if (first + added > options_.max_elements ||
        mesh_.polygon_ends.size() + primitive.triangles.size() / 3 > options_.max_elements)
      refuse(name_, "holds more than " + std::to_string(options_.max_elements) +
                        " vertices or triangles in its scene; cut it into pieces");
    for (std::size_t v = 0; v < added; ++v) {
      const Eigen::Vector3d p(primitive.positions[3 * v], primitive.positions[3 * v + 1],
                              primitive.positions[3 * v + 2]);
      mesh_.positions.push_back((world * p.homogeneous()).head<3>());
    }
    // A mirroring transform turns triangles over (glTF 2.0, 3.7.4).
    const bool mirrored = world.topLeftCorner<3, 3>().determinant() < 0;
    const std::vector<std::uint32_t>& t = primitive.triangles;
    const auto base = static_cast<std::uint32_t>(first);
    for (std::size_t i = 0; i + 2 < t.size(); i += 3)
      mesh_.add_triangle(base + t[i], base + t[i + (mirrored ? 2 : 1)],
                         base + t[i + (mirrored ? 1 : 2)]);
    append_attributes(primitive, world, first);
    for (const std::string& name : primitive.unread_attributes)
      notes_.insert("Vertex attribute " + in_quotes(name) + " is not read.");
  }

  void append_attributes(const GltfPrimitive& primitive, const Eigen::Matrix4d& world,
                         std::size_t first) {
    for (const VertexAttribute& from : primitive.attributes)
      attribute_of(mesh_, from.name, from.components);
    for (VertexAttribute& to : mesh_.attributes) {
      const auto width = static_cast<std::size_t>(to.components);
      // Where a primitive has no colour it is white, as glTF draws it.
      to.values.resize(mesh_.positions.size() * width, to.name.starts_with("COLOR_") ? 1.0f : 0.0f);
      for (const VertexAttribute& from : primitive.attributes)
        if (from.name == to.name)
          std::copy(from.values.begin(), from.values.end(),
                    to.values.begin() + static_cast<std::ptrdiff_t>(first * width));
      if (to.name == "NORMAL") turn_normals(to, world, first);
    }
  }

  static void turn_normals(VertexAttribute& normals, const Eigen::Matrix4d& world,
                           std::size_t first) {
    // The cofactor matrix: the inverse transpose but for a scale, defined for every transform.
    const Eigen::Matrix3d m = world.topLeftCorner<3, 3>();
    Eigen::Matrix3d cofactor;
    cofactor << m.col(1).cross(m.col(2)), m.col(2).cross(m.col(0)), m.col(0).cross(m.col(1));
    const double side = m.determinant() < 0 ? -1.0 : 1.0;
    for (std::size_t i = first * 3; i + 2 < normals.values.size(); i += 3) {
      Eigen::Map<Eigen::Vector3f> normal(normals.values.data() + i);
      normal = (side * cofactor * normal.cast<double>()).normalized().cast<float>();
    }
  }

  void note_the_rest() {
    if (!model_.materials.empty()) notes_.insert("Materials are not carried.");
    if (!model_.textures.empty()) notes_.insert("Textures are not carried.");
    if (!model_.animations.empty()) notes_.insert("Animations are not carried.");
    if (!model_.cameras.empty()) notes_.insert("Cameras are not carried.");
    if (!model_.lights.empty()) notes_.insert("Lights are not carried.");
    if (model_.nodes.size() > 1)
      notes_.insert("The node hierarchy is not carried: all geometry is in the scene's space.");
    if (read_meshes_.size() < model_.meshes.size())
      notes_.insert(counted(model_.meshes.size() - read_meshes_.size(), "mesh object") +
                    " outside the scene not read.");
    mesh_.not_carried.assign(notes_.begin(), notes_.end());
  }

  const tinygltf::Model& model_;
  const ImportOptions& options_;
  const std::string& name_;
  GltfAccessors accessors_;
  PolygonMesh mesh_;
  std::set<int> read_meshes_;
  std::set<std::string> notes_;
};

}  // namespace

PolygonMesh read_gltf(const InputBytes& input, const ImportOptions& options) {
  const GltfContainer container = read_gltf_container(input, options);
  const tinygltf::Model model = parse_model(container, input.name);
  check_required_extensions(model, input.name);
  PolygonMesh mesh = SceneReader(model, container, options, input.name).read();
  mesh.format = container.is_binary ? "GLB" : "glTF";
  return mesh;
}

}  // namespace zerotree::importer
