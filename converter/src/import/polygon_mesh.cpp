#include "import/polygon_mesh.h"

#include <string_view>

#include "import/import_error.h"

namespace zerotree::importer {
namespace {

std::string describe(std::string_view attribute) {
  if (attribute == "NORMAL")
    return "Vertex normals are read but not carried: the output's normals are those of its smooth "
           "surface.";
  if (attribute.starts_with("COLOR_")) return "Vertex colours are read but not carried.";
  if (attribute.starts_with("TEXCOORD_")) return "Texture coordinates are read but not carried.";
  return "Vertex attribute " + std::string(attribute) + " is read but not carried.";
}

}  // namespace

void append_triangle_strip(const std::vector<std::uint32_t>& strip, PolygonMesh& mesh) {
  for (std::size_t i = 0; i + 2 < strip.size(); ++i) {
    const std::uint32_t a = strip[i], b = strip[i + 1], c = strip[i + 2];
    if (a == b || b == c || a == c) continue;
    if (i % 2 == 0) {
      mesh.add_triangle(a, b, c);
    } else {
      mesh.add_triangle(b, a, c);
    }
  }
}

VertexAttribute& attribute_of(PolygonMesh& mesh, const std::string& name, int components) {
  for (VertexAttribute& attribute : mesh.attributes)
    if (attribute.name == name) return attribute;
  mesh.attributes.push_back({name, components, {}});
  VertexAttribute& made = mesh.attributes.back();
  made.values.resize(mesh.positions.size() * static_cast<std::size_t>(components));
  return made;
}

void note_what_is_not_carried(PolygonMesh& mesh) {
  for (const VertexAttribute& attribute : mesh.attributes)
    mesh.not_carried.push_back(describe(attribute.name));
  if (mesh.skipped_polygons > 0)
    mesh.not_carried.push_back(counted(mesh.skipped_polygons, "face") +
                               " of fewer than three corners left out.");
}

}  // namespace zerotree::importer
