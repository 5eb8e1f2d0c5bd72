#include "gltf/property_check.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>

namespace zerotree::gltf {
namespace {

using nlohmann::json;

constexpr double kMaxInteger = 9007199254740992.0;

std::set<std::string> declared_extensions(const JsonCursor& root) {
  std::set<std::string> names;
  const auto used = root.value().find("extensionsUsed");
  if (used == root.value().end() || !used->is_array()) return names;
  for (const json& name : *used) {
    if (!name.is_string()) return {};
    names.insert(name.get<std::string>());
  }
  return names;
}

bool is_integer(const json& value) {
  return value.is_number() && value.get<double>() == std::floor(value.get<double>());
}

std::string number_text(double value) {
  return json(value).dump();
}

// A value that does not pass reads as null; `report` and `mismatch` return that.
class PropertyChecker {
 public:
  PropertyChecker(const JsonCursor& root, Issues& issues)
      : root_(root), declared_(declared_extensions(root)), issues_(issues) {}

  json check(const JsonCursor& place, const ObjectType& type) {
    json right = json::object();
    for (const Property& property : type.properties) {
      const JsonCursor value = place.member(property.name);
      const bool is_there = value.exists() && !value.value().is_null();
      json checked = value.exists() ? check_value(value, property) : json();
      if (property.is_required && !is_there)
        report(place, IssueCode::undefined_property, json(property.name).dump());
      if (is_there && property.kind != PropertyKind::any)
        right[std::string(property.name)] = std::move(checked);
    }
    for (const auto& [key, value] : place.value().items())
      if (key != "extensions" && key != "extras" && !knows(type, key))
        report(place.member(key), IssueCode::unexpected_property, "");
    check_extensions(place.member("extensions"));
    return right;
  }

 private:
  static bool knows(const ObjectType& type, const std::string& key) {
    return std::any_of(type.properties.begin(), type.properties.end(),
                       [&](const Property& property) { return property.name == key; });
  }

  // The root's pointer is empty; glTF-Validator writes it as "/" where it says what is missing.
  json report(const JsonCursor& place, IssueCode code, std::string detail) {
    const bool lacks = code == IssueCode::undefined_property && place.pointer().empty();
    issues_.push_back({code, place.pointer(), std::move(detail)});
    if (lacks) issues_.back().pointer.assign(1, '/');
    return {};
  }
  json mismatch(const JsonCursor& place, const char* expected) {
    return report(place, IssueCode::type_mismatch, std::string(expected) + " is expected");
  }

  json check_value(const JsonCursor& place, const Property& property) {
    const json& value = place.value();
    switch (property.kind) {
      case PropertyKind::any:
        return {};
      case PropertyKind::index:
        return check_index(place, property);
      case PropertyKind::integer:
        return check_integer(place, property);
      case PropertyKind::number:
        if (!value.is_number()) return mismatch(place, "a number");
        return is_in_range(place, property) ? value : json();
      case PropertyKind::boolean:
        return value.is_boolean() ? value : mismatch(place, "true or false");
      case PropertyKind::string:
        return value.is_string() ? value : mismatch(place, "a string");
      case PropertyKind::name:
        return check_name(place, property);
      case PropertyKind::object:
        return value.is_object() ? check(place, *property.type) : mismatch(place, "an object");
      case PropertyKind::index_map:
        return check_index_map(place, property);
      default:
        return check_list(place, property);
    }
  }

  bool is_in_range(const JsonCursor& place, const Property& property) {
    const double number = place.value().get<double>();
    if (number >= property.min && number <= property.max) return true;
    report(place, IssueCode::value_not_in_range, number_text(number));
    return false;
  }

  json check_integer(const JsonCursor& place, const Property& property) {
    if (!is_integer(place.value())) return mismatch(place, "an integer");
    const double number = place.value().get<double>();
    if (property.values.empty()) {
      if (!is_in_range(place, property)) return {};
    } else if (std::find(property.values.begin(), property.values.end(), number) ==
               property.values.end()) {
      return report(place, IssueCode::value_not_in_list, number_text(number));
    }
    return static_cast<std::uint64_t>(std::min(number, kMaxInteger));
  }

  json check_name(const JsonCursor& place, const Property& property) {
    if (!place.value().is_string()) return mismatch(place, "a string");
    const auto& text = place.value().get_ref<const std::string&>();
    if (std::find(property.names.begin(), property.names.end(), text) != property.names.end())
      return text;
    return report(place, IssueCode::value_not_in_list, place.value().dump());
  }

  json check_index(const JsonCursor& place, const Property& property) {
    if (!is_integer(place.value())) return mismatch(place, "an integer");
    if (place.value().get<double>() < 0) return report(place, IssueCode::invalid_index, "");
    return resolved(place, property);
  }

  // Of an element, which may be no index at all.
  json check_index_element(const JsonCursor& place, const Property& property) {
    if (!is_integer(place.value()) || place.value().get<double>() < 0)
      return report(place, IssueCode::invalid_index, "");
    return resolved(place, property);
  }

  json resolved(const JsonCursor& place, const Property& property) {
    const auto index =
        static_cast<std::uint64_t>(std::min(place.value().get<double>(), kMaxInteger));
    const auto list = root_.value().find(property.target);
    const bool is_list = list != root_.value().end() && list->is_array();
    if (is_list && index < list->size() && (*list)[index].is_object()) return index;
    return report(place, IssueCode::unresolved_reference,
                  std::to_string(index) + " of " + std::to_string(is_list ? list->size() : 0));
  }

  json check_index_map(const JsonCursor& place, const Property& property) {
    if (!place.value().is_object()) return mismatch(place, "an object");
    if (place.value().empty()) return report(place, IssueCode::empty_entity, "");
    json right = json::object();
    for (const auto& [key, value] : place.value().items()) {
      right[key] = check_index_element(place.member(key), property);
    }
    return right;
  }

  json check_list(const JsonCursor& place, const Property& property) {
    if (!place.value().is_array()) return mismatch(place, "an array");
    const std::size_t size = place.size();
    if (size == 0) return report(place, IssueCode::empty_entity, "");
    if (property.length != 0 && size != property.length)
      return report(place, IssueCode::array_length_not_in_list,
                    std::to_string(size) + " instead of " + std::to_string(property.length));
    json right = json::array();
    bool is_right = true;
    std::set<json> seen;
    for (std::size_t i = 0; i < size; ++i) {
      right.push_back(check_element(place, i, property));
      const bool is_different =
          property.kind == PropertyKind::strings || property.kind == PropertyKind::indices;
      if (is_different && !right.back().is_null() && !seen.insert(right.back()).second)
        report(place.element(i), IssueCode::duplicate_elements, right.back().dump());
      is_right = is_right && !right.back().is_null();
    }
    const bool may_have_gaps =
        property.kind == PropertyKind::root_list || property.kind == PropertyKind::indices;
    return is_right || may_have_gaps ? right : json();
  }

  json check_element(const JsonCursor& list, std::size_t i, const Property& property) {
    const JsonCursor place = list.element(i);
    const json& value = place.value();
    switch (property.kind) {
      case PropertyKind::numbers:
        if (!value.is_number())
          return report(list, IssueCode::array_type_mismatch, "element " + std::to_string(i));
        return is_in_range(place, property) ? value : json();
      case PropertyKind::indices:
        return check_index_element(place, property);
      case PropertyKind::strings:
        return value.is_string() ? value : report(place, IssueCode::array_type_mismatch, "");
      case PropertyKind::root_list:
        return value.is_object() ? check(place, *property.type) : mismatch(place, "an object");
      default:
        if (value.is_object()) return check(place, *property.type);
        return report(list, IssueCode::array_type_mismatch, "element " + std::to_string(i));
    }
  }

  void check_extensions(const JsonCursor& extensions) {
    if (!extensions.exists()) return;
    if (!extensions.value().is_object()) {
      mismatch(extensions, "an object");
      return;
    }
    for (const auto& [name, value] : extensions.value().items()) {
      const JsonCursor extension = extensions.member(name);
      if (!value.is_object()) mismatch(extension, "an object");
      if (!declared_.contains(name)) report(extension, IssueCode::undeclared_extension, "");
    }
  }

  const JsonCursor& root_;
  const std::set<std::string> declared_;
  Issues& issues_;
};

const json kNull;
const json kEmpty = json::array();

}  // namespace

json checked_object(const JsonCursor& root, const JsonCursor& place, const ObjectType& type,
                    Issues& issues) {
  return PropertyChecker(root, issues).check(place, type);
}

std::uint64_t integer_or(const json& object, const char* key, std::uint64_t fallback) {
  if (!object.is_object()) return fallback;
  const auto found = object.find(key);
  if (found == object.end()) return fallback;
  return found->is_null() ? kNoIndex : found->get<std::uint64_t>();
}

const json& list_or_empty(const json& object, const char* key) {
  if (!object.is_object()) return kEmpty;
  const auto found = object.find(key);
  return found == object.end() || found->is_null() ? kEmpty : *found;
}

const json& element_or_null(const json& root, const char* list, std::uint64_t index) {
  const json& elements = list_or_empty(root, list);
  return index < elements.size() ? elements[index] : kNull;
}

}  // namespace zerotree::gltf
