// Compares JSON objects with the tables of properties.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>

#include "gltf/json_cursor.h"
#include "gltf/property_table.h"

namespace zerotree::gltf {

/// Adds to `issues` all that is wrong with the object at `place`, which is of `type` and a part of
/// the glTF document `root`: missing and unknown properties, wrong types and values, indices that
/// name nothing, undeclared extensions. Codes and pointers are glTF-Validator's.
///
/// Returns what is right, so that others can read it without checks: properties that passed,
/// without those of kind `any`; integers as unsigned ones of at most 2^53. Elements of root lists
/// keep their places; one that is no object is null. Takes time and memory linear in the size of
/// the object.
nlohmann::json checked_object(const JsonCursor& root, const JsonCursor& place,
                              const ObjectType& type, Issues& issues);

/// What a wrong integer reads as, and a missing index.
inline constexpr std::uint64_t kNoIndex = ~std::uint64_t{0};

/// An integer of a checked object, or of null.
std::uint64_t integer_or(const nlohmann::json& object, const char* key, std::uint64_t fallback);
/// A list of a checked object, or of null; empty if it is missing.
const nlohmann::json& list_or_empty(const nlohmann::json& object, const char* key);
/// Element of a root list of the checked document; null if there is none.
const nlohmann::json& element_or_null(const nlohmann::json& root, const char* list,
                                      std::uint64_t index);

}  // namespace zerotree::gltf
