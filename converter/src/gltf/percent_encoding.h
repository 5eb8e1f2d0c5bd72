// File names as URI references and back (RFC 3986, section 2.1).
#pragma once

#include <string>
#include <string_view>

namespace zerotree::gltf {

/// `name` (bytes, normally UTF-8) as a relative URI reference of one segment.
std::string percent_encoded(std::string_view name);
/// The bytes that `uri` stands for; a % that no two hex digits follow stays as it is.
std::string percent_decoded(std::string_view uri);

}  // namespace zerotree::gltf
