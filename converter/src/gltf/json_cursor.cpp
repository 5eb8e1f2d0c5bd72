#include "gltf/json_cursor.h"

#include <algorithm>
#include <cmath>

namespace zerotree::gltf {
namespace {

constexpr double kMaxInteger = 9007199254740992.0;

}  // namespace

std::string escaped_key(std::string_view key) {
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

JsonCursor JsonCursor::member(std::string_view key) const {
  JsonCursor place{nullptr, pointer_ + "/" + escaped_key(key)};
  if (!exists()) {
    place.owner_ = owner_;
    place.lacking_ = lacking_;
    return place;
  }
  if (!value_->is_object()) fail(IssueCode::type_mismatch, "an object is expected");
  const auto found = value_->find(key);
  if (found != value_->end()) {
    place.value_ = &*found;
  } else {
    place.owner_ = pointer_;
    place.lacking_ = key;
  }
  return place;
}

JsonCursor JsonCursor::element(std::uint64_t index) const {
  if (index >= size())
    throw IssueFound({IssueCode::unresolved_reference, pointer_ + "/" + std::to_string(index),
                      "there are " + std::to_string(size())});
  return {&(*value_)[index], pointer_ + "/" + std::to_string(index)};
}

JsonCursor JsonCursor::resolve(const JsonCursor& list) const {
  const std::uint64_t number = index();
  if (number >= list.size())
    fail(IssueCode::unresolved_reference,
         std::to_string(number) + ", there are " + std::to_string(list.size()));
  return list.element(number);
}

const nlohmann::json& JsonCursor::value() const {
  if (!exists()) fail(IssueCode::undefined_property, "");
  return *value_;
}

std::size_t JsonCursor::size() const {
  if (!exists()) return 0;
  if (!value_->is_array()) fail(IssueCode::type_mismatch, "an array is expected");
  return value_->size();
}

double JsonCursor::integer() const {
  const double number = this->number();
  if (number != std::floor(number)) fail(IssueCode::type_mismatch, "an integer is expected");
  return number;
}

std::uint64_t JsonCursor::unsigned_integer() const {
  const double number = integer();
  if (number < 0) fail(IssueCode::value_not_in_range, "an integer of at least 0 is expected");
  return static_cast<std::uint64_t>(std::min(number, kMaxInteger));
}

std::uint64_t JsonCursor::unsigned_integer_or(std::uint64_t fallback) const {
  return exists() ? unsigned_integer() : fallback;
}

std::uint64_t JsonCursor::index() const {
  if (integer() < 0) fail(IssueCode::invalid_index, "");
  return unsigned_integer();
}

double JsonCursor::number() const {
  if (!value().is_number()) fail(IssueCode::type_mismatch, "a number is expected");
  return value_->get<double>();
}

std::string JsonCursor::string() const {
  if (!value().is_string()) fail(IssueCode::type_mismatch, "a string is expected");
  return value_->get<std::string>();
}

void JsonCursor::fail(IssueCode code, std::string detail) const {
  if (exists() || lacking_.empty()) throw IssueFound({code, pointer_, std::move(detail)});
  throw IssueFound({code, owner_.empty() ? "/" : owner_,
                    "\"" + lacking_ + "\"" + (detail.empty() ? "" : ", ") + detail});
}

}  // namespace zerotree::gltf
