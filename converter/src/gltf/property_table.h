// The properties of glTF's core objects and of the extension, as tables: what a schema says.
#pragma once

#include <limits>
#include <span>
#include <string_view>

namespace zerotree::gltf {

/// What the value of a property is. Lists have at least one element.
enum class PropertyKind {
  any,      // not looked into
  index,    // an element of the list at the root that `target` names
  integer,  // in min..max, or one of `values`
  number,   // in min..max
  boolean,
  string,
  name,       // a string, one of `names`
  numbers,    // a list of numbers in min..max, `length` of them unless that is 0
  indices,    // a list of different indices
  strings,    // a list of different strings
  object,     // of type `type`
  objects,    // a list of such; one element of another kind spoils it
  root_list,  // a list of such at the root; an element of another kind leaves a gap
  index_map,  // an object whose values are indices
};

struct ObjectType;

struct Property {
  std::string_view name;
  PropertyKind kind;
  bool is_required = false;
  std::string_view target = {};
  double min = -std::numeric_limits<double>::max();
  double max = std::numeric_limits<double>::max();
  std::size_t length = 0;
  std::span<const int> values = {};
  std::span<const std::string_view> names = {};
  const ObjectType* type = nullptr;
};

/// Beside its properties every object may have `extensions` and `extras`.
struct ObjectType {
  std::span<const Property> properties;
};

/// Types of `accessor.type`, and how many components each has.
inline constexpr std::string_view kAccessorTypes[] = {"SCALAR", "VEC2", "VEC3", "VEC4",
                                                      "MAT2",   "MAT3", "MAT4"};
inline constexpr std::size_t kComponentCounts[] = {1, 2, 3, 4, 4, 9, 16};

/// The glTF object as a whole. Animations, cameras, images, samplers, skins, textures and morph
/// targets are not looked into.
extern const ObjectType kRootType;
/// The object of the extension ZEROTREE_mesh_progressive, as its schema describes it.
extern const ObjectType kExtensionType;

}  // namespace zerotree::gltf
