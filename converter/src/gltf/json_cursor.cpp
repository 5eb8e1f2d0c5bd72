#include "gltf/json_cursor.h"

#include <cmath>

namespace zerotree::gltf {
namespace {

// Integers beyond are not exact in the readers that keep all JSON numbers as doubles.
constexpr double kMaxInteger = 9007199254740992.0;

// RFC 6901, section 3.
std::string escaped(std::string_view key) {
  std::string text;
  for (char c : key) {
    if (c == '~')
      text += "~0";
    else if (c == '/')
      text += "~1";
    else
      text += c;
  }
  return text;
}

}  // namespace

JsonCursor JsonCursor::member(std::string_view key) const {
  const std::string pointer = pointer_ + "/" + escaped(key);
  if (!exists()) return {nullptr, pointer};
  if (!value_->is_object()) fail(IssueCode::property_type, "an object is expected");
  const auto found = value_->find(key);
  return {found == value_->end() ? nullptr : &*found, pointer};
}

JsonCursor JsonCursor::element(std::uint64_t index) const {
  JsonCursor place{nullptr, pointer_ + "/" + std::to_string(index)};
  if (index >= size())
    place.fail(IssueCode::index_unresolved, "there are " + std::to_string(size()));
  place.value_ = &(*value_)[index];
  return place;
}

const nlohmann::json& JsonCursor::value() const {
  if (!exists()) fail(IssueCode::property_missing, "");
  return *value_;
}

std::size_t JsonCursor::size() const {
  if (!exists()) return 0;
  if (!value_->is_array()) fail(IssueCode::property_type, "an array is expected");
  return value_->size();
}

std::uint64_t JsonCursor::unsigned_integer() const {
  const double number = this->number();
  if (number != std::floor(number)) fail(IssueCode::property_type, "an integer is expected");
  if (number < 0 || number > kMaxInteger)
    fail(IssueCode::property_value, "an integer of at least 0 and at most 2^53 is expected");
  return static_cast<std::uint64_t>(number);
}

std::uint64_t JsonCursor::unsigned_integer_or(std::uint64_t fallback) const {
  return exists() ? unsigned_integer() : fallback;
}

double JsonCursor::number() const {
  if (!value().is_number()) fail(IssueCode::property_type, "a number is expected");
  return value_->get<double>();
}

std::string JsonCursor::string() const {
  if (!value().is_string()) fail(IssueCode::property_type, "a string is expected");
  return value_->get<std::string>();
}

void JsonCursor::fail(IssueCode code, std::string detail) const {
  throw IssueFound({code, pointer_, std::move(detail)});
}

}  // namespace zerotree::gltf
