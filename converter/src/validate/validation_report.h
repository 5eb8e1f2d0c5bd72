// The result of validating a file, in the shape of glTF-Validator's report.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "gltf/issue_table.h"

namespace zerotree::validate {

/// An entry of a prefixes table, measured against the source. Errors are in the mesh's unit.
struct MeasuredEntry {
  std::uint64_t bytes = 0;
  double stated_error = 0;
  double measured_error = 0;
};

/// A progressive mesh, or the one of an elementary stream.
struct MeshInfo {
  /// JSON pointer to the mesh; empty for an elementary stream.
  std::string pointer;
  int levels = 0;
  std::uint64_t base_vertices = 0;
  std::uint64_t base_triangles = 0;
  /// Vertices of the finest level; 0 if it was not reached.
  std::uint64_t finest_vertices = 0;
  /// Triangles of the finest level, whether or not it was reached.
  std::uint64_t finest_triangles = 0;
  std::uint64_t payload_bytes = 0;
  std::uint64_t prefix_entries = 0;
  /// Prefixes whose surface was looked at.
  std::uint64_t prefixes_decoded = 0;
  /// Of the table's last entry, relative to the source's diagonal and in metres; 0 without a table.
  double stated_error = 0, stated_error_metres = 0;
  /// Only if there was a source to measure against.
  std::vector<MeasuredEntry> measured;
};

struct ValidationReport {
  /// The file as it was named.
  std::string uri;
  /// "model/gltf-binary", "model/gltf+json" or "application/octet-stream" for .zt; empty if
  /// unknown.
  std::string mime_type;
  gltf::Issues issues;
  /// The file could not be read: nothing is known of it.
  bool is_unreadable = false;
  /// Time it took; not part of the JSON, which is the same for the same file.
  double seconds = 0;
  /// Of the glTF file; empty if unknown.
  std::string version;
  std::string generator;
  std::vector<std::string> extensions_used;
  /// Meshes with the extension, whether or not they could be read.
  std::size_t progressive_meshes = 0;
  std::vector<MeshInfo> meshes;
  /// Of the file and all files it names; 0 unless there was a budget to compare with.
  std::uint64_t total_bytes = 0;
};

/// Issues of `severity`.
std::size_t count_issues(const ValidationReport& report, gltf::Severity severity);

/// "error", "warning", "info" or "hint".
const char* severity_name(gltf::Severity severity);

/// "severity CODE at pointer: message", safe to print: files have no say over the terminal.
std::string issue_line(const gltf::Issue& issue);

/// {uri, mimeType, validatorVersion, issues {numErrors, ..., messages}, info {...}}: of a glTF file
/// valid against glTF-Validator's validation.schema.json. What is not known is left out: mimeType,
/// and info if the file has neither a glTF version nor a mesh. Bytes that are no UTF-8 stay as they
/// are: dump it with error_handler_t::replace.
nlohmann::ordered_json to_json(const ValidationReport& report);

}  // namespace zerotree::validate
