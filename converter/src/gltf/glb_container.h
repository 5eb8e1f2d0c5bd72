// The GLB container (glTF 2.0, chapter "GLB File Format"): a JSON chunk and a binary chunk.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "gltf/issue_table.h"

namespace zerotree::gltf {

/// The chunks of a GLB file that may have been cut off anywhere.
struct GlbChunks {
  std::string_view json;
  /// As much of the binary chunk as there is; empty if the file has none.
  std::span<const std::uint8_t> binary;
  bool has_binary = false;
  /// Length of the binary chunk as its header states it.
  std::uint64_t binary_length = 0;
  /// The file is shorter than its header states.
  bool is_truncated = false;
};

bool is_glb(std::span<const std::uint8_t> file);

/// Finds the chunks; the result points into `file`. What is wrong with the container goes to
/// `issues`: codes of glTF-Validator that begin with GLB_, each with an empty pointer. Throws
/// IssueFound if that leaves no JSON to read. A binary chunk that is cut off leaves what is there.
GlbChunks split_glb(std::span<const std::uint8_t> file, Issues& issues);
/// The same; throws IssueFound for the first error unless it is that the file was cut off.
GlbChunks split_glb(std::span<const std::uint8_t> file);

/// Header and chunks up to the binary chunk's first byte. The file is this, the binary data and
/// zeros up to a multiple of 4. Throws Error(target_not_reachable) if GLB's 4 GiB do not suffice.
std::vector<std::uint8_t> glb_head(std::string_view json, std::uint64_t binary_length);

}  // namespace zerotree::gltf
