// The result of validating a file, in the shape of glTF-Validator's report.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "gltf/issue_table.h"

namespace zerotree::validate {

/// A progressive mesh, or the one of an elementary stream.
struct MeshInfo {
  /// JSON pointer to the mesh; empty for an elementary stream.
  std::string pointer;
  int levels = 0;
  std::uint64_t base_vertices = 0;
  std::uint64_t base_triangles = 0;
  /// Vertices of the finest level; 0 if it was not reached.
  std::uint64_t finest_vertices = 0;
  std::uint64_t payload_bytes = 0;
  std::uint64_t prefix_entries = 0;
};

struct ValidationReport {
  /// The file as it was named.
  std::string uri;
  /// "model/gltf-binary", "model/gltf+json" or "application/octet-stream" for .zt.
  std::string mime_type;
  gltf::Issues issues;
  /// Of the glTF file; empty if unknown.
  std::string version;
  std::string generator;
  std::vector<std::string> extensions_used;
  std::vector<MeshInfo> meshes;
};

/// Issues of `severity`.
std::size_t count_issues(const ValidationReport& report, gltf::Severity severity);

/// {uri, mimeType, validatorVersion, issues {numErrors, ..., messages}, info {...}}.
nlohmann::ordered_json to_json(const ValidationReport& report);

}  // namespace zerotree::validate
