#include <draco/compression/decode.h>

#include <optional>

#include "import/draco_decoding.h"
#include "import/import_error.h"
#include "import/mesh_readers.h"

namespace zerotree::importer {
namespace {

std::optional<std::uint64_t> read_varint(std::string_view bytes, std::size_t& at) {
  std::uint64_t value = 0;
  for (unsigned shift = 0; shift < 63 && at < bytes.size(); shift += 7) {
    const auto byte = static_cast<unsigned char>(bytes[at++]);
    value |= static_cast<std::uint64_t>(byte & 0x7f) << shift;
    if (byte < 0x80) return value;
  }
  return std::nullopt;
}

// Draco allocates what the stream's counts ask for before it looks at the rest, so they are read
// ahead here: bitstream specification 2.2, sections 2 (header) and 4 (connectivity).
void check_counts(std::string_view bytes, const ImportOptions& options, const std::string& place) {
  constexpr std::size_t header_size = 11;
  constexpr std::uint64_t most_per_byte = 4096;  // edgebreaker's best on a regular grid is below
  constexpr unsigned has_metadata = 0x80;
  if (bytes.size() < header_size) refuse(place, "the Draco stream is truncated; fetch it again");
  const bool edgebreaker = bytes[8] == 1;
  if ((static_cast<unsigned char>(bytes[10]) & has_metadata) != 0) return;  // counts come later
  std::size_t at = header_size + (edgebreaker ? 1 : 0);
  for (int i = 0; i < 2; ++i) {
    const std::optional<std::uint64_t> count = read_varint(bytes, at);
    if (!count) refuse_at_byte(place, at, "the Draco stream is truncated; fetch it again");
    if (*count > options.max_elements || *count > most_per_byte * bytes.size())
      refuse_at_byte(place, at,
                     "the Draco stream announces " + std::to_string(*count) +
                         " elements, more than it can hold; it is damaged, encode it again");
  }
}

void check_faces(const draco::Mesh& mesh, const std::string& place) {
  for (draco::FaceIndex f(0); f < mesh.num_faces(); ++f)
    for (draco::PointIndex point : mesh.face(f))
      if (point.value() >= mesh.num_points())
        refuse(place, "Draco face " + std::to_string(f.value()) + " names point " +
                          std::to_string(point.value()) + " of " +
                          std::to_string(mesh.num_points()) + "; encode the mesh again");
}

void add_attribute(const draco::Mesh& source, draco::GeometryAttribute::Type type, const char* name,
                   const std::vector<draco::PointIndex>& point_of_vertex, const std::string& place,
                   PolygonMesh& mesh) {
  const draco::PointAttribute* attribute = source.GetNamedAttribute(type);
  if (attribute == nullptr) return;
  const int components = attribute->num_components();
  if (components < 1 || components > 4) return;
  VertexAttribute& target = attribute_of(mesh, name, components);
  float* to = target.values.data();
  for (draco::PointIndex point : point_of_vertex) {
    double values[4] = {};
    draco_values(*attribute, attribute->mapped_index(point), components, values, place);
    for (int i = 0; i < components; ++i) *to++ = static_cast<float>(values[i]);
  }
}

}  // namespace

std::unique_ptr<draco::Mesh> decode_draco_mesh(std::string_view bytes, const ImportOptions& options,
                                               const std::string& place) {
  check_counts(bytes, options, place);
  draco::DecoderBuffer buffer;
  buffer.Init(bytes.data(), bytes.size());
  const auto type = draco::Decoder::GetEncodedGeometryType(&buffer);
  if (!type.ok() || type.value() != draco::TRIANGULAR_MESH)
    refuse(place, "the Draco stream is no triangle mesh; encode a mesh with faces");
  draco::Decoder decoder;
  auto result = decoder.DecodeMeshFromBuffer(&buffer);
  if (!result.ok())
    refuse(place, "the Draco stream is damaged (" + result.status().error_msg_string() +
                      "); encode the mesh again");
  std::unique_ptr<draco::Mesh> mesh = std::move(result).value();
  check_faces(*mesh, place);
  return mesh;
}

void draco_values(const draco::PointAttribute& attribute, draco::AttributeValueIndex value,
                  int components, double* out, const std::string& place) {
  if (value.value() >= attribute.size() ||
      !attribute.ConvertValue<double>(value, static_cast<std::int8_t>(components), out))
    refuse(place, "a Draco attribute has fewer values than points; encode the mesh again");
}

PolygonMesh read_draco(const InputBytes& input, const ImportOptions& options) {
  const std::unique_ptr<draco::Mesh> source = decode_draco_mesh(input.bytes, options, input.name);
  const draco::PointAttribute* positions =
      source->GetNamedAttribute(draco::GeometryAttribute::POSITION);
  if (positions == nullptr || positions->num_components() != 3)
    refuse(input.name, "the Draco mesh has no three-dimensional positions; encode it again");
  PolygonMesh mesh;
  mesh.format = "Draco";
  // Points are split at seams of any attribute; position values are the vertices.
  const std::size_t vertices = positions->size();
  mesh.positions.resize(vertices);
  for (std::uint32_t v = 0; v < vertices; ++v)
    draco_values(*positions, draco::AttributeValueIndex(v), 3, mesh.positions[v].data(),
                 input.name);
  std::vector<draco::PointIndex> point_of_vertex(vertices, draco::PointIndex(0));
  for (draco::FaceIndex f(0); f < source->num_faces(); ++f) {
    for (draco::PointIndex point : source->face(f)) {
      const std::uint32_t vertex = positions->mapped_index(point).value();
      if (vertex >= vertices)
        refuse(input.name, "a Draco point names a position that is not there; encode it again");
      mesh.corners.push_back(vertex);
      point_of_vertex[vertex] = point;
    }
    mesh.end_polygon();
  }
  if (source->num_points() == 0) return mesh;
  using Attribute = draco::GeometryAttribute;
  add_attribute(*source, Attribute::NORMAL, "NORMAL", point_of_vertex, input.name, mesh);
  add_attribute(*source, Attribute::COLOR, "COLOR_0", point_of_vertex, input.name, mesh);
  add_attribute(*source, Attribute::TEX_COORD, "TEXCOORD_0", point_of_vertex, input.name, mesh);
  return mesh;
}

}  // namespace zerotree::importer
