#include "validate/validation_report.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "validate/printable_text.h"

namespace zerotree::validate {
namespace {

using gltf::Severity;
using nlohmann::ordered_json;

ordered_json issues_json(const ValidationReport& report) {
  ordered_json messages = ordered_json::array();
  for (const gltf::Issue& issue : report.issues) {
    const gltf::IssueText& row = gltf::issue_text(issue.code);
    messages.push_back({{"code", row.id},
                        {"message", gltf::issue_message(issue)},
                        {"severity", static_cast<int>(row.severity)},
                        {"pointer", issue.pointer}});
  }
  return {{"numErrors", count_issues(report, Severity::error)},
          {"numWarnings", count_issues(report, Severity::warning)},
          {"numInfos", count_issues(report, Severity::information)},
          {"numHints", count_issues(report, Severity::hint)},
          {"messages", std::move(messages)},
          {"truncated", false}};
}

ordered_json measured_json(const std::vector<MeasuredEntry>& entries) {
  ordered_json list = ordered_json::array();
  for (const MeasuredEntry& entry : entries)
    list.push_back({{"byteLength", entry.bytes},
                    {"geometricError", entry.stated_error},
                    {"measuredError", entry.measured_error}});
  return list;
}

ordered_json mesh_json(const MeshInfo& mesh) {
  ordered_json json = {{"pointer", mesh.pointer},
                       {"levels", mesh.levels},
                       {"baseVertexCount", mesh.base_vertices},
                       {"baseTriangleCount", mesh.base_triangles},
                       {"finestVertexCount", mesh.finest_vertices},
                       {"finestTriangleCount", mesh.finest_triangles},
                       {"payloadByteLength", mesh.payload_bytes},
                       {"prefixCount", mesh.prefix_entries},
                       {"prefixesDecoded", mesh.prefixes_decoded}};
  if (!mesh.measured.empty()) json["measuredPrefixes"] = measured_json(mesh.measured);
  return json;
}

ordered_json info_json(const ValidationReport& report) {
  ordered_json meshes = ordered_json::array();
  for (const MeshInfo& mesh : report.meshes) meshes.push_back(mesh_json(mesh));
  ordered_json info = ordered_json::object();
  if (!report.version.empty()) info["version"] = report.version;
  if (!report.generator.empty()) info["generator"] = report.generator;
  if (!report.extensions_used.empty()) info["extensionsUsed"] = report.extensions_used;
  if (report.total_bytes > 0) info["totalByteLength"] = report.total_bytes;
  info["progressiveMeshes"] = std::move(meshes);
  return info;
}

}  // namespace

std::size_t count_issues(const ValidationReport& report, Severity severity) {
  return static_cast<std::size_t>(std::count_if(
      report.issues.begin(), report.issues.end(),
      [&](const gltf::Issue& issue) { return gltf::issue_text(issue.code).severity == severity; }));
}

const char* severity_name(Severity severity) {
  switch (severity) {
    case Severity::error:
      return "error";
    case Severity::warning:
      return "warning";
    case Severity::information:
      return "info";
    case Severity::hint:
      return "hint";
  }
  return "";
}

std::string issue_line(const gltf::Issue& issue) {
  const gltf::IssueText& row = gltf::issue_text(issue.code);
  std::string line = std::string(severity_name(row.severity)) + " " + row.id;
  if (!issue.pointer.empty()) line.append(" at ").append(issue.pointer);
  return printable_line(line.append(": ").append(gltf::issue_message(issue)));
}

ordered_json to_json(const ValidationReport& report) {
  ordered_json json = {{"uri", report.uri}};
  if (!report.mime_type.empty()) json["mimeType"] = report.mime_type;
  json["validatorVersion"] = ZEROTREE_VERSION;
  json["issues"] = issues_json(report);
  if (!report.version.empty() || !report.meshes.empty()) json["info"] = info_json(report);
  return json;
}

}  // namespace zerotree::validate
