// How the readers refuse a file.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace zerotree::importer {

/// Throws Error(unreadable_input) "FILE: PROBLEM".
[[noreturn]] void refuse(const std::string& file, const std::string& problem);

/// Throws Error(unreadable_input) "FILE, line LINE: PROBLEM".
[[noreturn]] void refuse_at_line(const std::string& file, std::size_t line,
                                 const std::string& problem);

/// Throws Error(unreadable_input) "FILE, byte OFFSET: PROBLEM".
[[noreturn]] void refuse_at_byte(const std::string& file, std::size_t offset,
                                 const std::string& problem);

/// `text` shortened and without control characters, in quotation marks: safe to show to a person.
std::string in_quotes(std::string_view text);

/// "1 face" or "3 faces".
std::string counted(std::size_t count, const std::string& noun);

}  // namespace zerotree::importer
