#include "gltf/primitive_check.h"

#include <algorithm>
#include <string>
#include <string_view>

#include "gltf/accessor_values.h"
#include "gltf/attribute_forms.h"
#include "gltf/base_layout.h"
#include "gltf/property_check.h"

namespace zerotree::gltf {
namespace {

using nlohmann::json;

constexpr std::uint64_t kArrayBuffer = 34962;
constexpr std::uint64_t kElementArrayBuffer = 34963;
constexpr std::uint64_t kUnsignedInt = 5125;
constexpr std::uint64_t kTriangles = 4;

std::string form_text(const LinkedAccessor& accessor) {
  return std::string(accessor.type) + " of " + std::to_string(accessor.component_type) +
         (accessor.is_normalized ? " normalized" : "");
}

bool suits_mode(std::uint64_t mode, std::uint64_t count) {
  switch (mode) {
    case 1:
      return count % 2 == 0;
    case 2:
    case 3:
      return count >= 2;
    case 4:
      return count % 3 == 0;
    case 5:
    case 6:
      return count >= 3;
    default:
      return true;
  }
}

class PrimitiveCheck {
 public:
  PrimitiveCheck(const json& core, const std::vector<LinkedAccessor>& accessors, Issues& issues)
      : accessors_(accessors),
        issues_(issues),
        uses_(accessors.size(), 0),
        shares_(accessors.size(), false),
        view_uses_(list_or_empty(core, "bufferViews").size(), 0),
        sharers_(view_uses_.size(), 0) {
    for (const json& name : list_or_empty(core, "extensionsUsed"))
      has_quantisation_ = has_quantisation_ || name == kQuantisationExtension;
  }

  void check(const json& primitive, const std::string& pointer) {
    const auto attributes = primitive.find("attributes");
    vertices_.reset();
    if (attributes != primitive.end() && attributes->is_object())
      check_attributes(*attributes, pointer + "/attributes");
    std::uint64_t count = vertices_.value_or(0);
    const std::uint64_t indices = integer_or(primitive, "indices", kNoIndex);
    if (indices != kNoIndex) {
      count = accessors_[indices].count;
      check_indices(indices, pointer + "/indices");
    }
    if (count != 0 && !suits_mode(integer_or(primitive, "mode", kTriangles), count))
      add(IssueCode::mesh_primitive_incompatible_mode, pointer, std::to_string(count));
  }

 private:
  void add(IssueCode code, const std::string& pointer, std::string detail) {
    issues_.push_back({code, pointer, std::move(detail)});
  }

  // POSITION comes first: it tells how many vertices there are.
  void check_attributes(const json& attributes, const std::string& pointer) {
    if (!attributes.contains("POSITION"))
      add(IssueCode::mesh_primitive_no_position, pointer, "");
    else
      check_attribute("POSITION", attributes["POSITION"], pointer);
    for (const auto& [name, index] : attributes.items()) {
      if (!is_attribute_name(name))
        add(IssueCode::mesh_primitive_invalid_attribute, pointer + "/" + escaped_key(name), "");
      if (name != "POSITION") check_attribute(name, index, pointer);
    }
  }

  void check_attribute(const std::string& name, const json& index, const std::string& attributes) {
    if (index.is_null()) return;
    const std::string pointer = attributes + "/" + escaped_key(name);
    const auto number = index.get<std::uint64_t>();
    const LinkedAccessor& accessor = accessors_[number];
    mark_use(number, kArrayBuffer, pointer);
    if (name == "POSITION" && (accessor.min.empty() || accessor.max.empty()))
      add(IssueCode::mesh_primitive_position_accessor_without_bounds, pointer, "");
    check_form(name, accessor, pointer);
    const bool has_view = accessor.view != kNoIndex;
    const bool may_straddle =
        has_view && accessor.byte_stride == 0 && accessor.element_size % 4 != 0;
    if ((accessor.byte_offset != kNoIndex && accessor.byte_offset % 4 != 0) || may_straddle)
      add(IssueCode::mesh_primitive_accessor_unaligned, pointer, "");
    if (!vertices_ && accessor.count != 0) vertices_ = accessor.count;
    if (vertices_ && *vertices_ != accessor.count)
      add(IssueCode::mesh_primitive_unequal_accessor_count, pointer,
          std::to_string(accessor.count) + " and " + std::to_string(*vertices_));
    if (!has_view || accessor.byte_stride != 0 || shares_[number]) return;
    shares_[number] = true;
    if (++sharers_[accessor.view] > 1)
      add(IssueCode::mesh_primitive_accessor_without_bytestride, pointer, "");
  }

  void check_form(const std::string& name, const LinkedAccessor& accessor,
                  const std::string& pointer) {
    const AttributeForm form{accessor.type, accessor.component_type, accessor.is_normalized};
    if (!has_fixed_forms(name)) {
      if (accessor.component_type == kUnsignedInt)
        add(IssueCode::mesh_primitive_attributes_accessor_unsigned_int, pointer, "");
    } else if (!is_attribute_form(name, form, has_quantisation_)) {
      add(IssueCode::mesh_primitive_attributes_accessor_invalid_format, pointer,
          form_text(accessor));
    } else if (name == "NORMAL" && accessor.values && accessor.values->non_unit) {
      add(IssueCode::accessor_vector3_non_unit, pointer,
          "element " + std::to_string(*accessor.values->non_unit));
    }
  }

  void check_indices(std::uint64_t number, const std::string& pointer) {
    const LinkedAccessor& accessor = accessors_[number];
    mark_use(number, kElementArrayBuffer, pointer);
    if (accessor.byte_stride != 0)
      add(IssueCode::mesh_primitive_indices_accessor_with_bytestride, pointer, "");
    const std::uint64_t type = accessor.component_type;
    if (accessor.type != "SCALAR" || accessor.is_normalized ||
        (type != 5121 && type != 5123 && type != kUnsignedInt)) {
      add(IssueCode::mesh_primitive_indices_accessor_invalid_format, pointer, form_text(accessor));
      return;
    }
    if (!accessor.values) return;
    const double largest = accessor.values->largest;
    const std::string detail = std::to_string(static_cast<std::uint64_t>(largest)) + " at index " +
                               std::to_string(accessor.values->largest_at);
    if (largest >= static_cast<double>(vertices_.value_or(0)))
      add(IssueCode::accessor_index_oob, pointer,
          detail + ", there are " + std::to_string(vertices_.value_or(0)) + " vertices");
    if (largest == component_range(type).second)
      add(IssueCode::accessor_index_primitive_restart, pointer, detail);
  }

  // Accessors and bufferViews serve one purpose; the first one, or the view's target, tells which.
  void mark_use(std::uint64_t number, std::uint64_t use, const std::string& pointer) {
    const LinkedAccessor& accessor = accessors_[number];
    if (uses_[number] == 0) uses_[number] = use;
    if (uses_[number] != use) add(IssueCode::accessor_usage_override, pointer, "");
    if (accessor.view == kNoIndex) return;
    std::uint64_t& view_use = view_uses_[accessor.view];
    if (view_use == 0) view_use = accessor.target == 0 ? use : accessor.target;
    if (view_use != use) add(IssueCode::buffer_view_target_override, pointer, "");
  }

  const std::vector<LinkedAccessor>& accessors_;
  Issues& issues_;
  bool has_quantisation_ = false;
  // Per accessor: its purpose, and whether it counts among the attributes of its view.
  std::vector<std::uint64_t> uses_;
  std::vector<bool> shares_;
  // Per bufferView: its purpose, and attributes that share it.
  std::vector<std::uint64_t> view_uses_, sharers_;
  std::optional<std::uint64_t> vertices_;
};

}  // namespace

void check_primitives(const json& core, const std::vector<LinkedAccessor>& accessors,
                      Issues& issues) {
  PrimitiveCheck check(core, accessors, issues);
  const json& meshes = list_or_empty(core, "meshes");
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    const json& primitives = list_or_empty(meshes[i], "primitives");
    for (std::size_t k = 0; k < primitives.size(); ++k)
      check.check(primitives[k],
                  "/meshes/" + std::to_string(i) + "/primitives/" + std::to_string(k));
  }
}

}  // namespace zerotree::gltf
