#include <algorithm>
#include <string_view>

#include "import/import_error.h"
#include "import/mesh_readers.h"
#include "import/text_cursor.h"

namespace zerotree::importer {
namespace {

// The prefixes of the keyword OFF: which values follow a vertex's position.
struct OffVariant {
  bool texture = false, colour = false, normal = false;
};

// The keyword is optional; `first` is then already the vertex count.
OffVariant read_variant(TextCursor& text, std::string_view& first) {
  OffVariant variant;
  if (!first.ends_with("OFF")) return variant;
  std::string_view prefix = first.substr(0, first.size() - 3);
  const auto take = [&prefix](std::string_view letter) {
    if (!prefix.starts_with(letter)) return false;
    prefix.remove_prefix(letter.size());
    return true;
  };
  variant.texture = take("ST");
  variant.colour = take("C");
  variant.normal = take("N");
  if (!prefix.empty())
    text.fail("OFF variant " + in_quotes(first) + " is not three-dimensional; export as plain OFF");
  first = text.token();
  if (first == "BINARY") text.fail("binary OFF is not read; export as ASCII OFF or as PLY");
  return variant;
}

std::uint64_t checked_count(TextCursor& text, std::string_view token, const char* what,
                            std::size_t smallest_row) {
  if (token.empty()) text.fail(std::string("the file ends before ") + what);
  const std::int64_t count = text.to_integer(token, what);
  if (count < 0 || static_cast<std::uint64_t>(count) > (text.remaining() + 1) / smallest_row)
    text.fail(std::string(what) + " is " + std::to_string(count) + ", but only " +
              std::to_string(text.remaining()) +
              " bytes follow; the file is damaged or truncated, export it again");
  return static_cast<std::uint64_t>(count);
}

// Integers of 0..255, or floats of 0..1: told apart by the token.
float colour_component(const TextCursor& text, std::string_view token) {
  const double value = text.to_number(token, "a colour");
  const bool is_float = token.find_first_of(".eE") != token.npos;
  return static_cast<float>(is_float ? value : value / 255.0);
}

void read_colour(TextCursor& text, std::uint64_t vertex, PolygonMesh& mesh) {
  VertexAttribute& colour = attribute_of(mesh, "COLOR_0", 4);
  float* rgba = colour.values.data() + vertex * 4;
  rgba[3] = 1.0f;
  for (int i = 0; i < 4; ++i) {
    const std::string_view token = text.token_on_line();
    if (token.empty()) break;
    rgba[i] = colour_component(text, token);
  }
}

void read_vertex(TextCursor& text, const OffVariant& variant, std::uint64_t vertex,
                 PolygonMesh& mesh) {
  Eigen::Vector3d p;
  for (int i = 0; i < 3; ++i) p[i] = text.number("a coordinate");
  if (!p.allFinite())
    text.fail("vertex " + std::to_string(vertex) +
              " has a coordinate that is not a finite number; repair the line");
  mesh.positions[vertex] = p;
  if (variant.normal)
    for (std::size_t i = 0; i < 3; ++i)
      attribute_of(mesh, "NORMAL", 3).values[vertex * 3 + i] =
          static_cast<float>(text.number("a normal"));
  // ST comes last in the line; a colour before it is then always r g b a.
  if (variant.colour) read_colour(text, vertex, mesh);
  if (variant.texture)
    for (std::size_t i = 0; i < 2; ++i)
      attribute_of(mesh, "TEXCOORD_0", 2).values[vertex * 2 + i] =
          static_cast<float>(text.number("a texture coordinate"));
  text.rest_of_line();
}

// Returns whether the line carries a colour behind the corners.
bool read_face(TextCursor& text, std::uint64_t face, PolygonMesh& mesh) {
  const std::int64_t corners = text.integer("a face's number of corners");
  if (corners < 0 || static_cast<std::uint64_t>(corners) > text.remaining())
    text.fail("a face of " + std::to_string(corners) + " corners; repair the line");
  for (std::int64_t i = 0; i < corners; ++i) {
    const std::int64_t index = text.integer("a face's vertex");
    if (index < 0 || static_cast<std::uint64_t>(index) >= mesh.positions.size())
      text.fail("face " + std::to_string(face) + " names vertex " + std::to_string(index) +
                ", but there are " + std::to_string(mesh.positions.size()) +
                " (counted from 0); export the file again");
    mesh.corners.push_back(static_cast<std::uint32_t>(index));
  }
  mesh.end_polygon();
  return !text.token_on_line().empty();
}

}  // namespace

PolygonMesh read_off(const InputBytes& input, const ImportOptions& options) {
  PolygonMesh mesh;
  TextCursor text(input.bytes, input.name);
  std::string_view first = text.token();
  const OffVariant variant = read_variant(text, first);
  mesh.format = "OFF";
  const std::uint64_t vertices = checked_count(text, first, "the number of vertices", 6);
  const std::uint64_t faces = checked_count(text, text.token(), "the number of faces", 2);
  if (std::max(vertices, faces) > options.max_elements)
    text.fail("more than " + std::to_string(options.max_elements) +
              " vertices or faces; cut the mesh into pieces");
  text.rest_of_line();  // the number of edges, which many files leave out or state as 0
  mesh.positions.resize(static_cast<std::size_t>(vertices), Eigen::Vector3d::Zero());
  mesh.polygon_ends.reserve(static_cast<std::size_t>(faces));
  for (std::uint64_t v = 0; v < vertices; ++v) read_vertex(text, variant, v, mesh);
  bool face_colours = false;
  for (std::uint64_t f = 0; f < faces; ++f) {
    face_colours |= read_face(text, f, mesh);
    text.rest_of_line();
  }
  if (face_colours) mesh.not_carried.push_back("Face colours are not read.");
  return mesh;
}

}  // namespace zerotree::importer
