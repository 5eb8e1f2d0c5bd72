#include "import/gltf_primitives.h"

#include <algorithm>
#include <numeric>

#include "import/draco_decoding.h"
#include "import/import_error.h"

namespace zerotree::importer {
namespace {

// A primitive's values by attribute name and its indices, whichever way they are stored.
class PrimitiveSource {
 public:
  PrimitiveSource() = default;
  virtual ~PrimitiveSource() = default;
  PrimitiveSource(const PrimitiveSource&) = delete;
  PrimitiveSource& operator=(const PrimitiveSource&) = delete;
  // Values of attribute `id`, and the components it has.
  virtual std::vector<double> values(int id, int& components) = 0;
  virtual std::vector<std::uint32_t> indices(std::size_t vertices) = 0;
};

class AccessorSource final : public PrimitiveSource {
 public:
  AccessorSource(GltfAccessors& accessors, int indices)
      : accessors_(accessors), indices_(indices) {}
  std::vector<double> values(int id, int& components) override {
    components = accessors_.components(id);
    return accessors_.values(id);
  }
  std::vector<std::uint32_t> indices(std::size_t vertices) override {
    if (indices_ >= 0) return accessors_.indices(indices_);
    std::vector<std::uint32_t> all(vertices);
    std::iota(all.begin(), all.end(), 0u);
    return all;
  }

 private:
  GltfAccessors& accessors_;
  int indices_;
};

class DracoSource final : public PrimitiveSource {
 public:
  DracoSource(std::string_view bytes, const ImportOptions& options, const std::string& place)
      : place_(place), mesh_(decode_draco_mesh(bytes, options, place)) {}
  std::vector<double> values(int id, int& components) override {
    const draco::PointAttribute* attribute =
        id < 0 ? nullptr : mesh_->GetAttributeByUniqueId(static_cast<std::uint32_t>(id));
    if (attribute == nullptr || attribute->num_components() < 1 || attribute->num_components() > 4)
      refuse(place_, "Draco attribute " + std::to_string(id) + " is not there; encode it again");
    components = attribute->num_components();
    const auto width = static_cast<std::size_t>(components);
    std::vector<double> result(mesh_->num_points() * width);
    for (std::uint32_t p = 0; p < mesh_->num_points(); ++p)
      draco_values(*attribute, attribute->mapped_index(draco::PointIndex(p)), components,
                   result.data() + p * width, place_);
    return result;
  }
  std::vector<std::uint32_t> indices(std::size_t) override {
    std::vector<std::uint32_t> result;
    for (draco::FaceIndex f(0); f < mesh_->num_faces(); ++f)
      for (draco::PointIndex point : mesh_->face(f)) result.push_back(point.value());
    return result;
  }

 private:
  const std::string& place_;
  std::unique_ptr<draco::Mesh> mesh_;
};

std::vector<float> to_attribute(const std::vector<double>& values, int from, int to, float fill) {
  std::vector<float> result;
  const std::size_t count = values.size() / static_cast<std::size_t>(from);
  result.reserve(count * static_cast<std::size_t>(to));
  for (std::size_t i = 0; i < count; ++i)
    for (int c = 0; c < to; ++c)
      result.push_back(
          c < from ? static_cast<float>(
                         values[i * static_cast<std::size_t>(from) + static_cast<std::size_t>(c)])
                   : fill);
  return result;
}

void read_attribute(const std::string& name, int id, PrimitiveSource& source,
                    const std::string& place, GltfPrimitive& result) {
  const bool colour = name.starts_with("COLOR_");
  if (!colour && name != "NORMAL" && !name.starts_with("TEXCOORD_")) {
    result.unread_attributes.push_back(name);
    return;
  }
  int components = 0;
  const std::vector<double> values = source.values(id, components);
  const int kept = colour ? 4 : name == "NORMAL" ? 3 : 2;
  if (values.size() / static_cast<std::size_t>(components) * 3 != result.positions.size())
    refuse(place, name + " has another number of values than POSITION; export it again");
  result.attributes.push_back({name, kept, to_attribute(values, components, kept, 1.0f)});
}

std::vector<std::uint32_t> resolve_mode(std::vector<std::uint32_t> indices, int mode) {
  std::vector<std::uint32_t> triangles;
  if (mode == TINYGLTF_MODE_TRIANGLES) {
    indices.resize(indices.size() / 3 * 3);
    return indices;
  }
  if (mode == TINYGLTF_MODE_TRIANGLE_STRIP) {
    PolygonMesh strip;
    append_triangle_strip(indices, strip);
    return std::move(strip.corners);
  }
  for (std::size_t i = 1; i + 1 < indices.size(); ++i)
    triangles.insert(triangles.end(), {indices[0], indices[i], indices[i + 1]});
  return triangles;
}

using AttributeIds = std::map<std::string, int>;

// The source, and the attributes under the ids that it knows them by.
std::unique_ptr<PrimitiveSource> open_source(const tinygltf::Primitive& primitive,
                                             GltfAccessors& accessors, const ImportOptions& options,
                                             const std::string& place, AttributeIds& ids) {
  ids = primitive.attributes;
  const auto draco = primitive.extensions.find("KHR_draco_mesh_compression");
  if (draco == primitive.extensions.end())
    return std::make_unique<AccessorSource>(accessors, primitive.indices);
  const tinygltf::Value& extension = draco->second;
  if (!extension.IsObject() || !extension.Get("bufferView").IsInt() ||
      !extension.Get("attributes").IsObject())
    refuse(place, "KHR_draco_mesh_compression lacks bufferView or attributes; export it again");
  for (const auto& [name, id] : extension.Get("attributes").Get<tinygltf::Value::Object>())
    ids[name] = id.IsInt() ? id.Get<int>() : -1;
  // Attributes outside the Draco stream would need its point order; none of the exporters does it.
  std::erase_if(ids,
                [&](const auto& entry) { return !extension.Get("attributes").Has(entry.first); });
  const std::string_view bytes = accessors.view_bytes(extension.Get("bufferView").Get<int>());
  return std::make_unique<DracoSource>(bytes, options, place);
}

}  // namespace

bool draws_triangles(const tinygltf::Primitive& primitive) {
  return primitive.mode == TINYGLTF_MODE_TRIANGLES ||
         primitive.mode == TINYGLTF_MODE_TRIANGLE_STRIP ||
         primitive.mode == TINYGLTF_MODE_TRIANGLE_FAN;
}

GltfPrimitive read_gltf_primitive(const tinygltf::Primitive& primitive, GltfAccessors& accessors,
                                  const ImportOptions& options, const std::string& place) {
  GltfPrimitive result;
  AttributeIds ids;
  const std::unique_ptr<PrimitiveSource> source =
      open_source(primitive, accessors, options, place, ids);
  const auto position = ids.find("POSITION");
  if (position == ids.end()) refuse(place, "has no POSITION attribute; export the file again");
  int components = 0;
  result.positions = source->values(position->second, components);
  if (components != 3) refuse(place, "POSITION is not three-dimensional; export the file again");
  for (const auto& [name, id] : ids)
    if (name != "POSITION") read_attribute(name, id, *source, place, result);
  const std::size_t vertices = result.positions.size() / 3;
  result.triangles = resolve_mode(source->indices(vertices), primitive.mode);
  for (std::size_t i = 0; i < result.triangles.size(); ++i)
    if (result.triangles[i] >= vertices)
      refuse(place, "triangle " + std::to_string(i / 3) + " names vertex " +
                        std::to_string(result.triangles[i]) + ", but there are " +
                        std::to_string(vertices) + "; export the file again");
  return result;
}

}  // namespace zerotree::importer
