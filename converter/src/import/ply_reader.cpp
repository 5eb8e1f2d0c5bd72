#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

#include "import/import_error.h"
#include "import/mesh_readers.h"
#include "import/ply_header.h"
#include "import/text_cursor.h"

namespace zerotree::importer {
namespace {

// Gives the values of the data part one after the other, whatever the encoding.
class PlyValues {
 public:
  PlyValues(const PlyHeader& header, const InputBytes& input)
      : encoding_(header.encoding),
        input_(input),
        text_(input.bytes, input.name, header.data_offset, header.data_line),
        at_(header.data_offset) {}

  double number(PlyType type) {
    if (encoding_ == PlyEncoding::ascii) return text_.number("a property's value");
    switch (type) {
      case PlyType::float32:
        return static_cast<double>(take<float>());
      case PlyType::float64:
        return take<double>();
      default:
        return static_cast<double>(integer(type));
    }
  }

  std::int64_t integer(PlyType type) {
    if (encoding_ == PlyEncoding::ascii) return text_.integer("an integer");
    switch (type) {
      case PlyType::int8:
        return take<std::int8_t>();
      case PlyType::uint8:
        return take<std::uint8_t>();
      case PlyType::int16:
        return take<std::int16_t>();
      case PlyType::uint16:
        return take<std::uint16_t>();
      case PlyType::int32:
        return take<std::int32_t>();
      case PlyType::uint32:
        return take<std::uint32_t>();
      default:
        fail("an index that is stored as a floating point number; export the file again");
    }
  }

  // A list's length; no longer than the bytes that are left can hold.
  std::size_t list_length(const PlyProperty& list) {
    const std::int64_t length = integer(list.count_type);
    const std::size_t left =
        encoding_ == PlyEncoding::ascii ? text_.remaining() : input_.bytes.size() - at_;
    const std::size_t smallest = encoding_ == PlyEncoding::ascii ? 1 : ply_type_size(list.type);
    if (length < 0 || static_cast<std::uint64_t>(length) > left / smallest)
      fail("a list of " + std::to_string(length) +
           " values, more than the file holds; it is damaged or truncated, export it again");
    return static_cast<std::size_t>(length);
  }

  [[noreturn]] void fail(const std::string& problem) const {
    if (encoding_ == PlyEncoding::ascii) text_.fail(problem);
    refuse_at_byte(input_.name, at_, problem);
  }

 private:
  template <class T>
  T take() {
    if (input_.bytes.size() - at_ < sizeof(T))
      fail("the file ends in the middle of its data; fetch or export it again");
    const T value = load_scalar<T>(input_.bytes.data() + at_, encoding_ == PlyEncoding::big_endian);
    at_ += sizeof(T);
    return value;
  }

  PlyEncoding encoding_;
  const InputBytes& input_;
  TextCursor text_;
  std::size_t at_;
};

void skip_value(PlyValues& values, const PlyProperty& property) {
  const std::size_t count = property.is_list ? values.list_length(property) : 1;
  for (std::size_t i = 0; i < count; ++i) values.number(property.type);
}

// Where a vertex property goes: component `component` of the position or of an attribute.
struct Destination {
  bool is_position = false;
  const char* attribute = nullptr;
  int component = 0;
};

std::optional<Destination> destination_of(std::string_view name) {
  struct Known {
    std::string_view name;
    Destination destination;
  };
  static constexpr std::array<Known, 19> known = {{
      {"x", {true, nullptr, 0}},
      {"y", {true, nullptr, 1}},
      {"z", {true, nullptr, 2}},
      {"nx", {false, "NORMAL", 0}},
      {"ny", {false, "NORMAL", 1}},
      {"nz", {false, "NORMAL", 2}},
      {"red", {false, "COLOR_0", 0}},
      {"green", {false, "COLOR_0", 1}},
      {"blue", {false, "COLOR_0", 2}},
      {"alpha", {false, "COLOR_0", 3}},
      {"r", {false, "COLOR_0", 0}},
      {"g", {false, "COLOR_0", 1}},
      {"b", {false, "COLOR_0", 2}},
      {"s", {false, "TEXCOORD_0", 0}},
      {"t", {false, "TEXCOORD_0", 1}},
      {"u", {false, "TEXCOORD_0", 0}},
      {"v", {false, "TEXCOORD_0", 1}},
      {"texture_u", {false, "TEXCOORD_0", 0}},
      {"texture_v", {false, "TEXCOORD_0", 1}},
  }};
  for (const Known& k : known)
    if (k.name == name) return k.destination;
  return std::nullopt;
}

// Integers stand for 0..1, as in every program that writes colours to PLY.
float unit_scale(PlyType type) {
  if (type == PlyType::uint8) return 1.0f / 255.0f;
  if (type == PlyType::uint16) return 1.0f / 65535.0f;
  return 1.0f;
}

// What to do with each vertex property, decided once.
struct VertexColumn {
  Destination destination;
  bool read = false;
  std::size_t attribute = 0;
  float scale = 1.0f;
};

std::vector<VertexColumn> plan_columns(const PlyElement& element, PolygonMesh& mesh) {
  std::vector<VertexColumn> columns;
  for (const PlyProperty& property : element.properties) {
    VertexColumn column;
    const std::optional<Destination> destination = destination_of(property.name);
    column.read = destination.has_value() && !property.is_list;
    if (!column.read) {
      mesh.not_carried.push_back("PLY vertex property " + in_quotes(property.name) +
                                 " is not read.");
    } else {
      column.destination = *destination;
    }
    if (column.read && !column.destination.is_position) {
      while (column.attribute < mesh.attributes.size() &&
             mesh.attributes[column.attribute].name != column.destination.attribute)
        ++column.attribute;
      if (column.attribute == mesh.attributes.size())
        mesh.attributes.push_back({column.destination.attribute, 0, {}});
      int& components = mesh.attributes[column.attribute].components;
      components = std::max(components, column.destination.component + 1);
      if (mesh.attributes[column.attribute].name == "COLOR_0")
        column.scale = unit_scale(property.type);
    }
    columns.push_back(column);
  }
  return columns;
}

void read_vertices(PlyValues& values, const PlyElement& element, PolygonMesh& mesh) {
  const std::vector<VertexColumn> columns = plan_columns(element, mesh);
  std::array<bool, 3> has_axis{};
  for (const VertexColumn& c : columns)
    if (c.read && c.destination.is_position)
      has_axis[static_cast<std::size_t>(c.destination.component)] = true;
  if (!has_axis[0] || !has_axis[1] || !has_axis[2])
    values.fail("vertices without x, y and z; repair the header or export the file again");
  const std::size_t count = static_cast<std::size_t>(element.count);
  mesh.positions.resize(count, Eigen::Vector3d::Zero());
  for (VertexAttribute& a : mesh.attributes)
    a.values.resize(count * static_cast<std::size_t>(a.components));

  for (std::size_t v = 0; v < count; ++v) {
    for (std::size_t c = 0; c < columns.size(); ++c) {
      const VertexColumn& column = columns[c];
      if (!column.read) {
        skip_value(values, element.properties[c]);
        continue;
      }
      const double value = values.number(element.properties[c].type);
      if (column.destination.is_position) {
        mesh.positions[v][column.destination.component] = value;
      } else {
        VertexAttribute& a = mesh.attributes[column.attribute];
        a.values[v * static_cast<std::size_t>(a.components) +
                 static_cast<std::size_t>(column.destination.component)] =
            static_cast<float>(value) * column.scale;
      }
    }
    if (!mesh.positions[v].allFinite())
      values.fail("vertex " + std::to_string(v + 1) +
                  " has a coordinate that is not a finite number; repair it in a mesh editor");
  }
}

std::uint32_t checked_vertex(const PlyValues& values, std::int64_t index, std::uint64_t vertices) {
  if (index < 0 || static_cast<std::uint64_t>(index) >= vertices)
    values.fail("a face names vertex " + std::to_string(index) + ", but there are " +
                std::to_string(vertices) + " (counted from 0); export the file again");
  return static_cast<std::uint32_t>(index);
}

// Strips are separated by -1 (Stanford's and Cyberware's files store one list for all faces).
void read_strips(PlyValues& values, const PlyProperty& list, std::uint64_t vertices,
                 PolygonMesh& mesh) {
  std::vector<std::uint32_t> strip;
  const std::size_t length = values.list_length(list);
  for (std::size_t i = 0; i < length; ++i) {
    const std::int64_t index = values.integer(list.type);
    if (index == -1) {
      append_triangle_strip(strip, mesh);
      strip.clear();
    } else {
      strip.push_back(checked_vertex(values, index, vertices));
    }
  }
  append_triangle_strip(strip, mesh);
}

void read_faces(PlyValues& values, const PlyElement& element, std::uint64_t vertices,
                PolygonMesh& mesh) {
  const bool strips = element.name == "tristrips";
  bool has_indices = false;
  for (const PlyProperty& p : element.properties) {
    if (p.name == "vertex_indices" || p.name == "vertex_index") {
      if (!p.is_list) values.fail("vertex_indices is not a list; repair the header");
      has_indices = true;
    } else {
      mesh.not_carried.push_back("PLY face property " + in_quotes(p.name) + " is not read.");
    }
  }
  if (!has_indices) values.fail("faces without vertex_indices; repair the header");
  if (!strips) mesh.polygon_ends.reserve(static_cast<std::size_t>(element.count));
  for (std::uint64_t f = 0; f < element.count; ++f) {
    for (const PlyProperty& p : element.properties) {
      if (p.name != "vertex_indices" && p.name != "vertex_index") {
        skip_value(values, p);
      } else if (strips) {
        read_strips(values, p, vertices, mesh);
      } else {
        const std::size_t corners = values.list_length(p);
        for (std::size_t i = 0; i < corners; ++i)
          mesh.corners.push_back(checked_vertex(values, values.integer(p.type), vertices));
        mesh.end_polygon();
      }
    }
  }
}

void skip_element(PlyValues& values, const PlyElement& element, PolygonMesh& mesh) {
  mesh.not_carried.push_back("PLY element " + in_quotes(element.name) + " is not read.");
  if (element.properties.empty()) return;  // rows without bytes, whatever their number
  for (std::uint64_t row = 0; row < element.count; ++row)
    for (const PlyProperty& p : element.properties) skip_value(values, p);
}

const char* format_name(PlyEncoding encoding) {
  if (encoding == PlyEncoding::ascii) return "PLY (ASCII)";
  return encoding == PlyEncoding::little_endian ? "PLY (binary little endian)"
                                                : "PLY (binary big endian)";
}

}  // namespace

PolygonMesh read_ply(const InputBytes& input, const ImportOptions& options) {
  const PlyHeader header = read_ply_header(input.bytes, input.name);
  PolygonMesh mesh;
  mesh.format = format_name(header.encoding);
  std::uint64_t vertices = 0;  // known from the header, as faces may come before vertices
  for (const PlyElement& element : header.elements) {
    if (element.name == "vertex") vertices = element.count;
    if (element.count > options.max_elements && !element.properties.empty())
      refuse(input.name, "holds more than " + std::to_string(options.max_elements) +
                             " of element " + in_quotes(element.name) +
                             "; cut the mesh into pieces");
  }
  PlyValues values(header, input);
  for (const PlyElement& element : header.elements) {
    if (element.name == "vertex") {
      read_vertices(values, element, mesh);
    } else if (element.name == "face" || element.name == "tristrips") {
      read_faces(values, element, vertices, mesh);
    } else {
      skip_element(values, element, mesh);
    }
  }
  return mesh;
}

}  // namespace zerotree::importer
