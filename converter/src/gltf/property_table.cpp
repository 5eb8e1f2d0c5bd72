#include "gltf/property_table.h"

#include <limits>

#include "gltf/progressive_asset.h"

namespace zerotree::gltf {
namespace {

using enum PropertyKind;

constexpr double kNoLimit = std::numeric_limits<double>::max();
constexpr double kAboveZero = std::numeric_limits<double>::denorm_min();
constexpr double kLargestFloat = std::numeric_limits<float>::max();
constexpr int kComponentTypes[] = {5120, 5121, 5122, 5123, 5125, 5126};
constexpr int kIndexTypes[] = {5121, 5123, 5125};
constexpr int kTargets[] = {34962, 34963};
constexpr std::string_view kAlphaModes[] = {"OPAQUE", "MASK", "BLEND"};

// Shapes of rows.
constexpr Property index_of(std::string_view name, std::string_view target, bool required = false) {
  return {.name = name, .kind = index, .is_required = required, .target = target};
}
constexpr Property count(std::string_view name, bool required, double min, double max = kNoLimit) {
  return {.name = name, .kind = integer, .is_required = required, .min = min, .max = max};
}
constexpr Property one_of(std::string_view name, bool required, std::span<const int> values) {
  return {.name = name, .kind = integer, .is_required = required, .values = values};
}
constexpr Property vector(std::string_view name, std::size_t length, double min = -kNoLimit,
                          double max = kNoLimit, bool required = false) {
  return {.name = name,
          .kind = numbers,
          .is_required = required,
          .min = min,
          .max = max,
          .length = length};
}
constexpr Property ranged(std::string_view name, double min, double max, bool required = false) {
  return {.name = name, .kind = number, .is_required = required, .min = min, .max = max};
}
constexpr Property list_of(std::string_view name, const ObjectType& type, bool required = false) {
  return {.name = name, .kind = objects, .is_required = required, .type = &type};
}
constexpr Property root_list_of(std::string_view name, const ObjectType& type) {
  return {.name = name, .kind = root_list, .type = &type};
}
constexpr Property object_of(std::string_view name, const ObjectType& type, bool required = false) {
  return {.name = name, .kind = object, .is_required = required, .type = &type};
}
constexpr Property plain(std::string_view name, PropertyKind kind) {
  return {.name = name, .kind = kind};
}

constexpr Property kAsset[] = {
    {.name = "version", .kind = string, .is_required = true},
    plain("minVersion", string),
    plain("generator", string),
    plain("copyright", string),
};
constexpr ObjectType kAssetType{kAsset};

constexpr Property kScene[] = {
    {.name = "nodes", .kind = indices, .target = "nodes"},
    plain("name", string),
};
constexpr ObjectType kSceneType{kScene};

constexpr Property kNode[] = {
    index_of("camera", "cameras"),
    {.name = "children", .kind = indices, .target = "nodes"},
    index_of("skin", "skins"),
    vector("matrix", 16),
    index_of("mesh", "meshes"),
    vector("rotation", 4, -1, 1),
    vector("scale", 3),
    vector("translation", 3),
    vector("weights", 0),
    plain("name", string),
};
constexpr ObjectType kNodeType{kNode};

constexpr Property kPrimitive[] = {
    {.name = "attributes", .kind = index_map, .is_required = true, .target = "accessors"},
    index_of("indices", "accessors"),
    index_of("material", "materials"),
    count("mode", false, 0, 6),
    plain("targets", any),
};
constexpr ObjectType kPrimitiveType{kPrimitive};

constexpr Property kMesh[] = {
    list_of("primitives", kPrimitiveType, true),
    vector("weights", 0),
    plain("name", string),
};
constexpr ObjectType kMeshType{kMesh};

constexpr Property kTextureInfo[] = {
    index_of("index", "textures", true), count("texCoord", false, 0),
    plain("scale", number),     // normalTexture
    plain("strength", number),  // occlusionTexture
};
constexpr ObjectType kTextureInfoType{kTextureInfo};

constexpr Property kMetallicRoughness[] = {
    vector("baseColorFactor", 4, 0, 1),
    object_of("baseColorTexture", kTextureInfoType),
    ranged("metallicFactor", 0, 1),
    ranged("roughnessFactor", 0, 1),
    object_of("metallicRoughnessTexture", kTextureInfoType),
};
constexpr ObjectType kMetallicRoughnessType{kMetallicRoughness};

constexpr Property kMaterial[] = {
    object_of("pbrMetallicRoughness", kMetallicRoughnessType),
    object_of("normalTexture", kTextureInfoType),
    object_of("occlusionTexture", kTextureInfoType),
    object_of("emissiveTexture", kTextureInfoType),
    vector("emissiveFactor", 3, 0, 1),
    {.name = "alphaMode", .kind = name, .names = kAlphaModes},
    ranged("alphaCutoff", 0, kNoLimit),
    plain("doubleSided", boolean),
    plain("name", string),
};
constexpr ObjectType kMaterialType{kMaterial};

constexpr Property kSparseIndices[] = {
    index_of("bufferView", "bufferViews", true),
    count("byteOffset", false, 0),
    one_of("componentType", true, kIndexTypes),
};
constexpr ObjectType kSparseIndicesType{kSparseIndices};

constexpr Property kSparseValues[] = {
    index_of("bufferView", "bufferViews", true),
    count("byteOffset", false, 0),
};
constexpr ObjectType kSparseValuesType{kSparseValues};

constexpr Property kSparse[] = {
    count("count", true, 1),
    object_of("indices", kSparseIndicesType, true),
    object_of("values", kSparseValuesType, true),
};
constexpr ObjectType kSparseType{kSparse};

// What min and max may be depends on the other properties.
constexpr Property kAccessor[] = {
    index_of("bufferView", "bufferViews"),
    count("byteOffset", false, 0),
    one_of("componentType", true, kComponentTypes),
    count("count", true, 1),
    {.name = "type", .kind = name, .is_required = true, .names = kAccessorTypes},
    plain("normalized", boolean),
    plain("max", any),
    plain("min", any),
    object_of("sparse", kSparseType),
    plain("name", string),
};
constexpr ObjectType kAccessorType{kAccessor};

constexpr Property kBufferView[] = {
    index_of("buffer", "buffers", true), count("byteOffset", false, 0),
    count("byteLength", true, 1),        count("byteStride", false, 4, 252),
    one_of("target", false, kTargets),   plain("name", string),
};
constexpr ObjectType kBufferViewType{kBufferView};

constexpr Property kBuffer[] = {
    plain("uri", string),
    count("byteLength", true, 1),
    plain("name", string),
};
constexpr ObjectType kBufferType{kBuffer};

constexpr Property kRoot[] = {
    plain("extensionsUsed", strings),
    plain("extensionsRequired", strings),
    root_list_of("accessors", kAccessorType),
    plain("animations", any),
    object_of("asset", kAssetType, true),
    root_list_of("buffers", kBufferType),
    root_list_of("bufferViews", kBufferViewType),
    plain("cameras", any),
    plain("images", any),
    root_list_of("materials", kMaterialType),
    root_list_of("meshes", kMeshType),
    root_list_of("nodes", kNodeType),
    plain("samplers", any),
    index_of("scene", "scenes"),
    root_list_of("scenes", kSceneType),
    plain("skins", any),
    plain("textures", any),
};

constexpr Property kBounds[] = {
    vector("min", 3, -kLargestFloat, kLargestFloat, true),
    vector("max", 3, -kLargestFloat, kLargestFloat, true),
};
constexpr ObjectType kBoundsType{kBounds};

constexpr Property kPrefix[] = {
    count("byteLength", true, 0),
    ranged("geometricError", 0, kNoLimit, true),
};
constexpr ObjectType kPrefixType{kPrefix};

constexpr Property kExtension[] = {
    index_of("bufferView", "bufferViews", true),
    count("levels", true, 0, kMaxLevels),
    plain("attributes", strings),
    object_of("bounds", kBoundsType, true),
    ranged("sourceDiagonal", kAboveZero, kNoLimit, true),
    list_of("prefixes", kPrefixType, true),
};

}  // namespace

const ObjectType kRootType{kRoot};
const ObjectType kExtensionType{kExtension};

}  // namespace zerotree::gltf
