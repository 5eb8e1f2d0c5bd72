#include <string_view>

#include "import/import_error.h"
#include "import/mesh_readers.h"
#include "import/text_cursor.h"

namespace zerotree::importer {
namespace {

constexpr std::size_t header_size = 84;  // 80 bytes of comment and the count
constexpr std::size_t facet_size = 50;   // normal, three corners, 16 bits of anything

std::uint64_t stated_facets(const std::string& bytes) {
  return bytes.size() < header_size ? 0 : load_scalar<std::uint32_t>(bytes.data() + 80, false);
}

// Many binary files begin with "solid" too, so the size decides first.
bool is_ascii(const std::string& bytes) {
  if (bytes.size() >= header_size &&
      bytes.size() == header_size + facet_size * stated_facets(bytes))
    return false;
  if (std::string_view(bytes).substr(0, 512).find('\0') != std::string_view::npos) return false;
  const std::size_t first = bytes.find_first_not_of(" \t\r\n");
  return first != bytes.npos && std::string_view(bytes).substr(first).starts_with("solid");
}

void add_facet(PolygonMesh& mesh) {
  const auto end = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.add_triangle(end - 3, end - 2, end - 1);
}

PolygonMesh read_binary(const InputBytes& input) {
  const std::string& bytes = input.bytes;
  if (bytes.size() < header_size)
    refuse(input.name,
           "is neither ASCII STL (no \"solid\") nor binary STL (shorter than 84 bytes)");
  const std::uint64_t facets = stated_facets(bytes);
  if (facets > (bytes.size() - header_size) / facet_size)
    refuse_at_byte(input.name, bytes.size(),
                   "the file ends early: its header announces " + counted(facets, "facet") +
                       " of " + std::to_string(facet_size) + " bytes; fetch or export it again");
  PolygonMesh mesh;
  mesh.format = "STL (binary)";
  mesh.positions.reserve(static_cast<std::size_t>(facets) * 3);
  mesh.polygon_ends.reserve(static_cast<std::size_t>(facets));
  bool has_attribute_bytes = false;
  for (std::uint64_t f = 0; f < facets; ++f) {
    const std::size_t offset = header_size + static_cast<std::size_t>(f) * facet_size;
    const char* facet = bytes.data() + offset;
    for (int corner = 1; corner <= 3; ++corner) {
      Eigen::Vector3d p;
      for (int i = 0; i < 3; ++i)
        p[i] = static_cast<double>(load_scalar<float>(facet + 12 * corner + 4 * i, false));
      if (!p.allFinite())
        refuse_at_byte(input.name, offset,
                       "facet " + std::to_string(f + 1) +
                           " has a coordinate that is not a finite number; export the mesh again");
      mesh.positions.push_back(p);
    }
    has_attribute_bytes |= facet[48] != 0 || facet[49] != 0;
    add_facet(mesh);
  }
  if (has_attribute_bytes)
    mesh.not_carried.push_back("STL attribute bytes (colours of some programs) are not read.");
  return mesh;
}

void read_facet(TextCursor& text, PolygonMesh& mesh) {
  for (std::string_view word = text.token(); word != "endfacet"; word = text.token()) {
    if (word.empty()) text.fail("the file ends inside a facet; fetch or export it again");
    if (word == "facet") text.fail("a facet without endfacet; repair the file");
    if (word != "vertex") continue;  // normal, outer loop, endloop
    Eigen::Vector3d p;
    for (int i = 0; i < 3; ++i) p[i] = text.number("a coordinate");
    if (!p.allFinite())
      text.fail("a coordinate that is not a finite number; repair it or export the mesh again");
    mesh.positions.push_back(p);
  }
}

PolygonMesh read_ascii(const InputBytes& input) {
  PolygonMesh mesh;
  mesh.format = "STL (ASCII)";
  TextCursor text(input.bytes, input.name);
  bool in_solid = false;
  for (std::string_view word = text.token(); !word.empty(); word = text.token()) {
    if (word == "solid") {
      in_solid = true;
      text.rest_of_line();
    } else if (word == "endsolid") {
      in_solid = false;
      text.rest_of_line();
    } else if (word == "facet") {
      const std::size_t before = mesh.positions.size();
      read_facet(text, mesh);
      if (mesh.positions.size() != before + 3)
        text.fail("a facet of " + counted(mesh.positions.size() - before, "corner") +
                  " instead of 3; triangulate the mesh before exporting it");
      add_facet(mesh);
    } else {
      text.fail("expected facet or endsolid, found " + in_quotes(word) + "; repair the line");
    }
  }
  if (in_solid) text.fail("the file ends without endsolid; it is truncated, fetch it again");
  return mesh;
}

}  // namespace

PolygonMesh read_stl(const InputBytes& input, const ImportOptions&) {
  return is_ascii(input.bytes) ? read_ascii(input) : read_binary(input);
}

}  // namespace zerotree::importer
