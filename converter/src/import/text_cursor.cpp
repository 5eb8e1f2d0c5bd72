#include "import/text_cursor.h"

#include <charconv>
#include <limits>

#include "import/import_error.h"

namespace zerotree::importer {
namespace {

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}

}  // namespace

std::string_view TextCursor::token_on_line() {
  while (at_ < text_.size() && is_blank(text_[at_])) ++at_;
  if (at_ < text_.size() && text_[at_] == '#')
    while (at_ < text_.size() && text_[at_] != '\n') ++at_;
  const std::size_t begin = at_;
  while (at_ < text_.size() && !is_blank(text_[at_]) && text_[at_] != '\n' && text_[at_] != '#')
    ++at_;
  return text_.substr(begin, at_ - begin);
}

std::string_view TextCursor::token() {
  std::string_view found = token_on_line();
  while (found.empty() && next_line()) found = token_on_line();
  return found;
}

std::string_view TextCursor::rest_of_line() {
  const std::size_t begin = at_;
  while (at_ < text_.size() && text_[at_] != '\n') ++at_;
  return text_.substr(begin, at_ - begin);
}

bool TextCursor::next_line() {
  rest_of_line();
  if (at_ == text_.size()) return false;
  ++at_;
  ++line_;
  return true;
}

double TextCursor::number(const char* what) {
  const std::string_view text = token();
  if (text.empty())
    fail(std::string("the file ends before ") + what + "; fetch or export it again");
  return to_number(text, what);
}

std::int64_t TextCursor::integer(const char* what) {
  const std::string_view text = token();
  if (text.empty())
    fail(std::string("the file ends before ") + what + "; fetch or export it again");
  return to_integer(text, what);
}

bool TextCursor::number_on_line(const char* what, double& value) {
  const std::string_view text = token_on_line();
  if (text.empty()) return false;
  value = to_number(text, what);
  return true;
}

double TextCursor::to_number(std::string_view text, const char* what) const {
  std::string_view digits = text;
  if (digits.starts_with('+')) digits.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (end != digits.data() + digits.size() || error == std::errc::invalid_argument)
    fail(std::string("expected ") + what + ", found " + in_quotes(text) + "; repair the line");
  // Too small for a double is zero, too large is infinite; from_chars does not tell which it was.
  if (error == std::errc::result_out_of_range)
    value = digits.find("e-") != digits.npos || digits.find("E-") != digits.npos
                ? 0.0
                : std::numeric_limits<double>::infinity();
  return value;
}

std::int64_t TextCursor::to_integer(std::string_view text, const char* what) const {
  std::string_view digits = text;
  if (digits.starts_with('+')) digits.remove_prefix(1);
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (end != digits.data() + digits.size() || error != std::errc())
    fail(std::string("expected ") + what + ", found " + in_quotes(text) + "; repair the line");
  return value;
}

void TextCursor::fail(const std::string& problem) const {
  refuse_at_line(*file_, line_, problem);
}

}  // namespace zerotree::importer
