// Checked reading of glTF's JSON: every failure names its place as a JSON pointer.
#pragma once

#include <cstdint>
#include <exception>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "gltf/issue_table.h"

namespace zerotree::gltf {

/// Thrown inside the gltf room where reading cannot go on; callers turn it into an entry of a list
/// of issues or into an Error.
class IssueFound : public std::exception {
 public:
  explicit IssueFound(Issue issue) : issue_(std::move(issue)) {}
  const Issue& issue() const { return issue_; }
  const char* what() const noexcept override { return issue_text(issue_.code).text; }

 private:
  Issue issue_;
};

/// A place in a JSON document, whether or not there is a value. The document must outlive it.
/// Functions that read a value throw IssueFound if it is missing or of another type.
class JsonCursor {
 public:
  explicit JsonCursor(const nlohmann::json& root) : value_(&root) {}

  /// The value of `key`; this value must be missing or an object.
  JsonCursor member(std::string_view key) const;
  /// Element `index`; it must exist, or the index is reported as unresolved.
  JsonCursor element(std::uint64_t index) const;

  bool exists() const { return value_ != nullptr; }
  const std::string& pointer() const { return pointer_; }
  const nlohmann::json& value() const;

  /// Number of elements; the value must be an array, a missing one has none.
  std::size_t size() const;
  /// An integer in 0..2^53, also when written like 12.0.
  std::uint64_t unsigned_integer() const;
  std::uint64_t unsigned_integer_or(std::uint64_t fallback) const;
  double number() const;
  std::string string() const;

  /// Throws IssueFound with this place.
  [[noreturn]] void fail(IssueCode code, std::string detail) const;

 private:
  JsonCursor(const nlohmann::json* value, std::string pointer)
      : value_(value), pointer_(std::move(pointer)) {}

  const nlohmann::json* value_;
  std::string pointer_;
};

}  // namespace zerotree::gltf
