// From text to JSON, with what glTF asks for beyond JSON: no byte order mark, no repeated keys.
#pragma once

#include <nlohmann/json.hpp>
#include <string_view>

namespace zerotree::gltf {

/// Arrays and objects inside each other; real files have about ten.
inline constexpr int kMostNesting = 256;

/// Parses `text`, which must be an object. Takes memory and time linear in its length. Throws
/// IssueFound: invalid_json, also for more than kMostNesting levels, json_key_repeated, or
/// type_mismatch if the value is no object.
nlohmann::json parse_json(std::string_view text);

}  // namespace zerotree::gltf
