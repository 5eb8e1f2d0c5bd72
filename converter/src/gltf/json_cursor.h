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

/// A key as it stands in a JSON pointer (RFC 6901, section 3).
std::string escaped_key(std::string_view key);

/// A place in a JSON document, whether or not there is a value. The document must outlive it.
/// Functions that read a value throw IssueFound if it is missing or of another type.
class JsonCursor {
 public:
  explicit JsonCursor(const nlohmann::json& root) : value_(&root) {}

  /// The value of `key`; this value must be missing or an object.
  JsonCursor member(std::string_view key) const;
  /// Element `index`; it must exist, or the index is reported as unresolved.
  JsonCursor element(std::uint64_t index) const;
  /// The element of `list` that the index here names.
  JsonCursor resolve(const JsonCursor& list) const;

  bool exists() const { return value_ != nullptr; }
  const std::string& pointer() const { return pointer_; }
  const nlohmann::json& value() const;

  /// Number of elements; the value must be an array, a missing one has none.
  std::size_t size() const;
  /// An integer of at least 0, also when written like 12.0. Those above 2^53 come out as 2^53:
  /// readers that keep numbers as doubles see no more, and no sum of two overflows.
  std::uint64_t unsigned_integer() const;
  std::uint64_t unsigned_integer_or(std::uint64_t fallback) const;
  /// The same; a negative one is reported as an invalid index.
  std::uint64_t index() const;
  double number() const;
  std::string string() const;

  /// Throws IssueFound with this place, or for a missing value with the object that lacks it.
  [[noreturn]] void fail(IssueCode code, std::string detail) const;

 private:
  JsonCursor(const nlohmann::json* value, std::string pointer)
      : value_(value), pointer_(std::move(pointer)) {}
  double integer() const;

  const nlohmann::json* value_;
  std::string pointer_;
  // For a missing value: the innermost object that exists, and the member it lacks.
  std::string owner_, lacking_;
};

}  // namespace zerotree::gltf
