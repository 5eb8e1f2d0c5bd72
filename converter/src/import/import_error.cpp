#include "import/import_error.h"

#include <string_view>

#include "mesh/error.h"

namespace zerotree::importer {

void refuse(const std::string& file, const std::string& problem) {
  throw Error(ExitCode::unreadable_input, file + ": " + problem);
}

void refuse_at_line(const std::string& file, std::size_t line, const std::string& problem) {
  refuse(file + ", line " + std::to_string(line), problem);
}

void refuse_at_byte(const std::string& file, std::size_t offset, const std::string& problem) {
  refuse(file + ", byte " + std::to_string(offset), problem);
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t shown = 40;
  std::string result = "\"";
  for (char c : text.substr(0, shown)) result += (c >= ' ' && c <= '~') ? c : '?';
  if (text.size() > shown) result += "...";
  return result + "\"";
}

std::string counted(std::size_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

}  // namespace zerotree::importer
