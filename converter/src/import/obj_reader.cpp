#include <algorithm>
#include <array>
#include <limits>
#include <set>
#include <string_view>

#include "import/import_error.h"
#include "import/mesh_readers.h"
#include "import/text_cursor.h"

namespace zerotree::importer {
namespace {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

// Texture coordinates or normals: a list of their own, named by face corners.
struct CornerValues {
  int components = 0;
  std::vector<float> values;
  /// Per vertex the value its first corner names, or `none`.
  std::vector<std::uint32_t> of_vertex;
  /// Corners that name another value than their vertex' first one.
  std::uint64_t seams = 0;
  std::uint64_t size() const { return values.size() / static_cast<std::size_t>(components); }
};

class ObjReader {
 public:
  explicit ObjReader(const InputBytes& input) : input_(input), text_(input.bytes, input.name) {}

  PolygonMesh read() {
    mesh_.format = "OBJ";
    do {
      read_line(text_.token_on_line());
    } while (text_.next_line());
    if (largest_vertex_ > mesh_.positions.size())
      refuse_at_line(input_.name, largest_vertex_line_,
                     "a face names vertex " + std::to_string(largest_vertex_) + ", but there are " +
                         std::to_string(mesh_.positions.size()) + "; export the file again");
    if (colours_.size() == mesh_.positions.size() * 3 && !colours_.empty())
      mesh_.attributes.push_back({"COLOR_0", 3, std::move(colours_)});
    keep_corner_values("TEXCOORD_0", texture_);
    keep_corner_values("NORMAL", normals_);
    note_statements();
    return std::move(mesh_);
  }

 private:
  void read_line(std::string_view keyword) {
    if (keyword == "v") {
      read_vertex();
    } else if (keyword == "vt") {
      read_values(texture_);
    } else if (keyword == "vn") {
      read_values(normals_);
    } else if (keyword == "f" || keyword == "fo") {  // fo: the old name of f
      read_face();
    } else if (!keyword.empty()) {
      note_statement(keyword);
    }
  }

  void read_vertex() {
    std::array<double, 7> numbers{};
    std::size_t count = 0;
    while (count < numbers.size() && text_.number_on_line("a coordinate", numbers[count])) ++count;
    if (count < 3) text_.fail("a vertex of fewer than 3 coordinates; repair the line");
    const Eigen::Vector3d p(numbers[0], numbers[1], numbers[2]);
    if (!p.allFinite())
      text_.fail("vertex " + std::to_string(mesh_.positions.size() + 1) +
                 " has a coordinate that is not a finite number; repair the line");
    mesh_.positions.push_back(p);
    // "x y z r g b", written by many scanners' programs; "x y z w" has no colour.
    if (count >= 6)
      for (std::size_t i = 3; i < 6; ++i) colours_.push_back(static_cast<float>(numbers[i]));
  }

  void read_values(CornerValues& list) {
    for (int i = 0; i < list.components; ++i) {
      double value = 0;
      text_.number_on_line("a number", value);  // a missing v of "vt u" is 0
      list.values.push_back(static_cast<float>(value));
    }
  }

  void read_face() {
    while (true) {
      const std::string_view corner = text_.token_on_line();
      if (corner.empty()) break;
      if (corner == "\\") {  // the statement goes on in the next line
        text_.next_line();
        continue;
      }
      read_corner(corner);
    }
    mesh_.end_polygon();
  }

  void read_corner(std::string_view corner) {
    const std::size_t slash = corner.find('/');
    const std::uint32_t vertex = vertex_index(corner.substr(0, slash));
    mesh_.corners.push_back(vertex);
    if (slash == corner.npos) return;
    std::string_view rest = corner.substr(slash + 1);
    const std::size_t second = rest.find('/');
    name_value(rest.substr(0, second), vertex, texture_);
    if (second != rest.npos) name_value(rest.substr(second + 1), vertex, normals_);
  }

  // OBJ counts from 1; negative indices count back from the last one so far.
  std::uint32_t vertex_index(std::string_view token) {
    const std::int64_t index = text_.to_integer(token, "a vertex index");
    const auto count = static_cast<std::int64_t>(mesh_.positions.size());
    const std::int64_t vertex = index < 0 ? count + index : index - 1;
    if (index == 0 || vertex < 0 || vertex >= static_cast<std::int64_t>(none))
      text_.fail("a face names vertex " + std::to_string(index) + ", but there are " +
                 std::to_string(count) + " so far; export the file again");
    // A later vertex is allowed; whether it comes is known at the end.
    if (static_cast<std::uint64_t>(vertex) + 1 > largest_vertex_) {
      largest_vertex_ = static_cast<std::uint64_t>(vertex) + 1;
      largest_vertex_line_ = text_.line();
    }
    return static_cast<std::uint32_t>(vertex);
  }

  // Values are not geometry: one that does not exist is left out and told, the face stays.
  void name_value(std::string_view token, std::uint32_t vertex, CornerValues& list) {
    if (token.empty()) return;
    const std::int64_t index = text_.to_integer(token, "an index");
    const auto count = static_cast<std::int64_t>(list.size());
    const std::int64_t value = index < 0 ? count + index : index - 1;
    // A vertex that is not there yet is not given memory on a face's word.
    if (value < 0 || value >= count || vertex >= mesh_.positions.size()) {
      ++unknown_values_;
      return;
    }
    if (list.of_vertex.size() < mesh_.positions.size())
      list.of_vertex.resize(mesh_.positions.size(), none);
    std::uint32_t& first = list.of_vertex[vertex];
    if (first == none) {
      first = static_cast<std::uint32_t>(value);
    } else if (first != static_cast<std::uint32_t>(value)) {
      ++list.seams;
    }
  }

  void keep_corner_values(const char* name, CornerValues& list) {
    if (list.of_vertex.empty()) return;
    list.of_vertex.resize(mesh_.positions.size(), none);
    VertexAttribute& attribute = attribute_of(mesh_, name, list.components);
    const auto width = static_cast<std::size_t>(list.components);
    for (std::size_t v = 0; v < list.of_vertex.size(); ++v)
      if (list.of_vertex[v] != none)
        std::copy_n(list.values.begin() + static_cast<std::ptrdiff_t>(list.of_vertex[v] * width),
                    width, attribute.values.begin() + static_cast<std::ptrdiff_t>(v * width));
    if (list.seams > 0)
      mesh_.not_carried.push_back("At " + counted(list.seams, "face corner") + " " + name +
                                  " differs from that of the vertex' first corner (a seam); only "
                                  "the first value is read.");
  }

  void note_statement(std::string_view keyword) {
    const bool known = keyword == "mtllib" || keyword == "usemtl" || keyword == "g" ||
                       keyword == "o" || keyword == "s" || keyword == "l" || keyword == "p";
    // No more than a few: a binary file is full of unknown words.
    constexpr std::size_t most_names = 8;
    if (known || statements_.size() < most_names) statements_.emplace(keyword);
  }

  void note_statements() {
    for (const std::string& keyword : statements_) {
      if (keyword == "usemtl") {
        mesh_.not_carried.push_back("Materials and their textures are not carried.");
      } else if (keyword == "g" || keyword == "o") {
        mesh_.not_carried.push_back("Names (" + keyword + ") are not carried.");
      } else if (keyword == "l" || keyword == "p") {
        mesh_.not_carried.push_back("Lines and points are not carried.");
      } else if (keyword != "mtllib" && keyword != "s") {
        mesh_.not_carried.push_back("OBJ statement " + in_quotes(keyword) + " is not read.");
      }
    }
    if (unknown_values_ > 0)
      mesh_.not_carried.push_back("At " + counted(unknown_values_, "face corner") +
                                  " the texture coordinate or normal does not exist.");
  }

  const InputBytes& input_;
  TextCursor text_;
  PolygonMesh mesh_;
  std::vector<float> colours_;
  CornerValues texture_{2, {}, {}, 0};
  CornerValues normals_{3, {}, {}, 0};
  std::uint64_t largest_vertex_ = 0;
  std::size_t largest_vertex_line_ = 0;
  std::uint64_t unknown_values_ = 0;
  std::set<std::string> statements_;
};

}  // namespace

PolygonMesh read_obj(const InputBytes& input, const ImportOptions&) {
  return ObjReader(input).read();
}

}  // namespace zerotree::importer
