#include "import/ply_header.h"

#include <array>
#include <string_view>
#include <utility>

#include "import/import_error.h"
#include "import/text_cursor.h"

namespace zerotree::importer {
namespace {

constexpr std::array<std::pair<std::string_view, PlyType>, 16> type_names = {{
    {"char", PlyType::int8},
    {"int8", PlyType::int8},
    {"uchar", PlyType::uint8},
    {"uint8", PlyType::uint8},
    {"short", PlyType::int16},
    {"int16", PlyType::int16},
    {"ushort", PlyType::uint16},
    {"uint16", PlyType::uint16},
    {"int", PlyType::int32},
    {"int32", PlyType::int32},
    {"uint", PlyType::uint32},
    {"uint32", PlyType::uint32},
    {"float", PlyType::float32},
    {"float32", PlyType::float32},
    {"double", PlyType::float64},
    {"float64", PlyType::float64},
}};

PlyType read_type(TextCursor& text) {
  const std::string_view name = text.token_on_line();
  for (const auto& [known, type] : type_names)
    if (name == known) return type;
  text.fail("unknown property type " + in_quotes(name) + "; export the file again");
}

void read_property(TextCursor& text, PlyElement& element) {
  constexpr std::size_t most_properties = 1000;
  if (element.properties.size() == most_properties)
    text.fail("more than 1000 properties in one element; export without the additional ones");
  PlyProperty property;
  TextCursor after_list = text;
  property.is_list = after_list.token_on_line() == "list";
  if (property.is_list) {
    text = after_list;
    property.count_type = read_type(text);
    if (property.count_type == PlyType::float32 || property.count_type == PlyType::float64)
      text.fail("a list length that is not an integer; export the file again");
  }
  property.type = read_type(text);
  property.name = text.token_on_line();
  if (property.name.empty()) text.fail("a property without a name; export the file again");
  element.properties.push_back(std::move(property));
}

PlyEncoding read_encoding(TextCursor& text) {
  const std::string_view name = text.token_on_line();
  if (name == "ascii") return PlyEncoding::ascii;
  if (name == "binary_little_endian") return PlyEncoding::little_endian;
  if (name == "binary_big_endian") return PlyEncoding::big_endian;
  text.fail("unknown PLY format " + in_quotes(name) + "; export as ascii or binary_little_endian");
}

void read_element(TextCursor& text, PlyHeader& header) {
  PlyElement element;
  element.name = text.token_on_line();
  for (const PlyElement& other : header.elements)
    if (other.name == element.name)
      text.fail("element " + in_quotes(element.name) + " is declared twice; repair the header");
  const std::string_view count_text = text.token_on_line();
  const std::int64_t count = text.to_integer(count_text, "the element's count");
  if (count < 0) text.fail("an element count below 0; repair the header");
  element.count = static_cast<std::uint64_t>(count);
  header.elements.push_back(std::move(element));
}

// Fewest bytes a row may take: in ASCII a digit and a separator per value.
std::size_t smallest_row(const PlyElement& element, PlyEncoding encoding) {
  std::size_t size = 0;
  for (const PlyProperty& p : element.properties)
    size += encoding == PlyEncoding::ascii ? 2 : ply_type_size(p.is_list ? p.count_type : p.type);
  return size;
}

void check_counts(const PlyHeader& header, std::size_t data_size, const std::string& file) {
  std::size_t needed = 0;
  for (const PlyElement& element : header.elements) {
    const std::size_t row = smallest_row(element, header.encoding);
    if (row == 0) continue;
    // + 1: the last ASCII value may end the file without a separator.
    if (element.count > (data_size + 1 - needed) / row)
      refuse_at_byte(file, header.data_offset,
                     "the header announces " + std::to_string(element.count) + " of element " +
                         in_quotes(element.name) + ", but only " + std::to_string(data_size) +
                         " bytes follow; the file is truncated, fetch or export it again");
    needed += element.count * row;
  }
}

}  // namespace

std::size_t ply_type_size(PlyType type) {
  switch (type) {
    case PlyType::int8:
    case PlyType::uint8:
      return 1;
    case PlyType::int16:
    case PlyType::uint16:
      return 2;
    case PlyType::int32:
    case PlyType::uint32:
    case PlyType::float32:
      return 4;
    case PlyType::float64:
      return 8;
  }
  return 8;
}

PlyHeader read_ply_header(const std::string& bytes, const std::string& file) {
  PlyHeader header;
  TextCursor text(bytes, file);
  if (text.token_on_line() != "ply") text.fail("the file does not begin with \"ply\"");
  bool has_format = false;
  while (true) {
    if (!text.next_line()) text.fail("the header has no end_header; the file is truncated");
    const std::string_view keyword = text.token_on_line();
    if (keyword == "end_header") break;
    if (keyword.empty() || keyword == "comment" || keyword == "obj_info") continue;
    if (keyword == "format") {
      header.encoding = read_encoding(text);
      has_format = true;
    } else if (keyword == "element") {
      read_element(text, header);
    } else if (keyword == "property") {
      if (header.elements.empty()) text.fail("a property before any element; repair the header");
      read_property(text, header.elements.back());
    } else {
      text.fail("unknown header line " + in_quotes(keyword) + "; repair the header");
    }
  }
  if (!has_format) text.fail("the header has no format line; repair the header");
  text.next_line();
  header.data_offset = bytes.size() - text.remaining();
  header.data_line = text.line();
  check_counts(header, text.remaining(), file);
  return header;
}

}  // namespace zerotree::importer
