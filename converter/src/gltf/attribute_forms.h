// Names of vertex attributes, and the forms their accessors may have.
#pragma once

#include <cstdint>
#include <string_view>

namespace zerotree::gltf {

struct AttributeForm {
  std::string_view type;
  std::uint64_t component_type = 0;
  bool is_normalized = false;

  bool operator==(const AttributeForm&) const = default;
};

/// A name of glTF's, such as TEXCOORD_1, or one of the application's own, which begins with _.
bool is_attribute_name(std::string_view name);
/// glTF says which forms the accessors of `name` may have.
bool has_fixed_forms(std::string_view name);
/// `form` is one of these, or `is_quantised` and KHR_mesh_quantization adds it.
bool is_attribute_form(std::string_view name, const AttributeForm& form, bool is_quantised);

}  // namespace zerotree::gltf
