#include "gltf/attribute_forms.h"

#include <algorithm>
#include <array>

namespace zerotree::gltf {
namespace {

constexpr std::uint64_t kByte = 5120, kUnsignedByte = 5121, kShort = 5122, kUnsignedShort = 5123,
                        kFloat = 5126;

struct Row {
  std::string_view semantic;
  AttributeForm form;
  bool needs_quantisation = false;
};

constexpr Row kForms[] = {
    {"POSITION", {"VEC3", kFloat}},
    {"POSITION", {"VEC3", kByte}, true},
    {"POSITION", {"VEC3", kByte, true}, true},
    {"POSITION", {"VEC3", kUnsignedByte}, true},
    {"POSITION", {"VEC3", kUnsignedByte, true}, true},
    {"POSITION", {"VEC3", kShort}, true},
    {"POSITION", {"VEC3", kShort, true}, true},
    {"POSITION", {"VEC3", kUnsignedShort}, true},
    {"POSITION", {"VEC3", kUnsignedShort, true}, true},
    {"NORMAL", {"VEC3", kFloat}},
    {"NORMAL", {"VEC3", kByte, true}, true},
    {"NORMAL", {"VEC3", kShort, true}, true},
    {"TANGENT", {"VEC4", kFloat}},
    {"TANGENT", {"VEC4", kByte, true}, true},
    {"TANGENT", {"VEC4", kShort, true}, true},
    {"TEXCOORD", {"VEC2", kFloat}},
    {"TEXCOORD", {"VEC2", kUnsignedByte, true}},
    {"TEXCOORD", {"VEC2", kUnsignedShort, true}},
    {"TEXCOORD", {"VEC2", kByte}, true},
    {"TEXCOORD", {"VEC2", kByte, true}, true},
    {"TEXCOORD", {"VEC2", kUnsignedByte}, true},
    {"TEXCOORD", {"VEC2", kShort}, true},
    {"TEXCOORD", {"VEC2", kShort, true}, true},
    {"TEXCOORD", {"VEC2", kUnsignedShort}, true},
    {"COLOR", {"VEC3", kFloat}},
    {"COLOR", {"VEC3", kUnsignedByte, true}},
    {"COLOR", {"VEC3", kUnsignedShort, true}},
    {"COLOR", {"VEC4", kFloat}},
    {"COLOR", {"VEC4", kUnsignedByte, true}},
    {"COLOR", {"VEC4", kUnsignedShort, true}},
    {"JOINTS", {"VEC4", kUnsignedByte}},
    {"JOINTS", {"VEC4", kUnsignedShort}},
    {"WEIGHTS", {"VEC4", kFloat}},
    {"WEIGHTS", {"VEC4", kUnsignedByte, true}},
    {"WEIGHTS", {"VEC4", kUnsignedShort, true}},
};
constexpr std::array<std::string_view, 3> kSingle = {"POSITION", "NORMAL", "TANGENT"};
constexpr std::array<std::string_view, 4> kNumbered = {"TEXCOORD", "COLOR", "JOINTS", "WEIGHTS"};

// Without the number.
std::string_view semantic_of(std::string_view name) {
  return name.substr(0, name.find('_'));
}

template <class Names>
bool contains(const Names& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

bool is_attribute_name(std::string_view name) {
  if (name.starts_with('_') || contains(kSingle, name)) return true;
  const std::string_view semantic = semantic_of(name);
  if (!contains(kNumbered, semantic) || semantic.size() == name.size()) return false;
  const std::string_view number = name.substr(semantic.size() + 1);
  const bool has_leading_zero = number.size() > 1 && number[0] == '0';
  return !number.empty() && !has_leading_zero &&
         number.find_first_not_of("0123456789") == number.npos;
}

bool has_fixed_forms(std::string_view name) {
  return contains(kSingle, semantic_of(name)) || contains(kNumbered, semantic_of(name));
}

bool is_attribute_form(std::string_view name, const AttributeForm& form, bool is_quantised) {
  return std::any_of(std::begin(kForms), std::end(kForms), [&](const Row& row) {
    return row.semantic == semantic_of(name) && row.form == form &&
           (is_quantised || !row.needs_quantisation);
  });
}

}  // namespace zerotree::gltf
