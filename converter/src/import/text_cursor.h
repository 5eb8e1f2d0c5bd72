// Walks through the text of a mesh file token by token, and knows the line it is on.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace zerotree::importer {

/// Tokens are separated by blanks; "#" begins a comment up to the end of the line. Failures are
/// Error(unreadable_input) naming file and line.
class TextCursor {
 public:
  /// `text` and `file` (its name in messages) must outlive the cursor. `offset`: where to begin;
  /// `line`: the number of the line there.
  TextCursor(std::string_view text, const std::string& file, std::size_t offset = 0,
             std::size_t line = 1)
      : text_(text), file_(&file), at_(offset), line_(line) {}

  /// The next token on this line; empty at its end.
  std::string_view token_on_line();
  /// The next token on this or a later line; empty at the end of the text.
  std::string_view token();
  /// What is left of this line, comment included; the cursor stays in front of the line's end.
  std::string_view rest_of_line();
  /// Goes to the beginning of the next line; false at the end of the text.
  bool next_line();

  /// The next token on this or a later line as a number; `what` names it in messages.
  double number(const char* what);
  std::int64_t integer(const char* what);
  /// The next number on this line; false at the line's end.
  bool number_on_line(const char* what, double& value);

  /// `text` as a number; refuses what is none. May be NaN or infinite where the text says so.
  double to_number(std::string_view text, const char* what) const;
  std::int64_t to_integer(std::string_view text, const char* what) const;

  std::size_t line() const { return line_; }
  /// Bytes not yet read.
  std::size_t remaining() const { return text_.size() - at_; }
  [[noreturn]] void fail(const std::string& problem) const;

 private:
  std::string_view text_;
  const std::string* file_;
  std::size_t at_;
  std::size_t line_;
};

}  // namespace zerotree::importer
