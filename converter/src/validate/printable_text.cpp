#include "validate/printable_text.h"

#include <algorithm>
#include <cstdint>

namespace zerotree::validate {
namespace {

// Bytes of the UTF-8 character at the front of `text` if XML 1.0 can hold it and it is no control,
// else 0.
std::size_t character_size(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(text[i]); };
  const std::uint8_t first = byte(0);
  if (first < 0x80)
    return (first >= 0x20 && first != 0x7f) || first == '\n' || first == '\t' ? 1 : 0;
  const std::size_t size = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  if (first < 0xc2 || first > 0xf4 || text.size() < size) return 0;
  std::uint32_t code = first & (0x7fu >> size);
  for (std::size_t i = 1; i < size; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return 0;
    code = code << 6 | (byte(i) & 0x3fu);
  }
  const bool is_overlong = code < (size == 2 ? 0x80u : size == 3 ? 0x800u : 0x10000u);
  // U+0080 to U+009F are controls; terminals may take U+009B for the start of a command.
  const bool is_no_character = code < 0xa0 || (code >= 0xd800 && code < 0xe000) || code == 0xfffe ||
                               code == 0xffff || code > 0x10ffff;
  return is_overlong || is_no_character ? 0 : size;
}

}  // namespace

std::string printable_text(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const std::size_t size = character_size(text);
    result += size > 0 ? text.substr(0, size) : std::string_view("\xef\xbf\xbd");
    text.remove_prefix(std::max<std::size_t>(size, 1));
  }
  return result;
}

std::string printable_line(std::string_view text) {
  std::string result = printable_text(text);
  std::replace_if(
      result.begin(), result.end(), [](char c) { return c == '\n' || c == '\t'; }, ' ');
  return result;
}

}  // namespace zerotree::validate
