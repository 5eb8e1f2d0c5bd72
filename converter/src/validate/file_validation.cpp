#include "validate/file_validation.h"

#include <algorithm>
#include <span>

#include "bitstream/stream_header.h"
#include "gltf/glb_container.h"
#include "gltf/progressive_reader.h"
#include "gltf/structure_check.h"
#include "validate/payload_check.h"

namespace zerotree::validate {
namespace {

using gltf::GltfDocument;
using gltf::IssueCode;
using gltf::IssueFound;

constexpr const char* kBinaryType = "model/gltf-binary";
constexpr const char* kJsonType = "model/gltf+json";
constexpr const char* kStreamType = "application/octet-stream";

MeshInfo mesh_info(std::string pointer, const PayloadFacts& facts) {
  MeshInfo info;
  info.pointer = std::move(pointer);
  info.levels = facts.levels;
  info.base_vertices = facts.base_vertices;
  info.base_triangles = facts.base_triangles;
  info.finest_vertices = facts.finest_vertices;
  return info;
}

void validate_stream(std::span<const std::uint8_t> file, const ValidateOptions& options,
                     ValidationReport& report) {
  const PayloadFacts facts = check_stream(file, options.max_vertices, report.issues);
  report.meshes.push_back(mesh_info("", facts));
  report.meshes.back().payload_bytes = file.size();
}

void read_asset_info(const GltfDocument& document, ValidationReport& report) {
  const gltf::JsonCursor asset = document.root().member("asset");
  report.version = asset.member("version").string();
  const gltf::JsonCursor generator = asset.member("generator");
  if (generator.exists() && generator.value().is_string()) report.generator = generator.string();
  const gltf::JsonCursor used = document.root().member("extensionsUsed");
  for (std::size_t i = 0; i < used.size(); ++i)
    if (used.element(i).value().is_string())
      report.extensions_used.push_back(used.element(i).string());
}

void validate_mesh(GltfDocument& document, std::size_t mesh, const ValidateOptions& options,
                   ValidationReport& report) {
  const std::string pointer = "/meshes/" + std::to_string(mesh);
  const auto asset = gltf::read_mesh(document, mesh, report.issues);
  if (!asset) return;
  const PayloadFacts facts = check_payload(*asset, pointer, options.max_vertices, report.issues);
  report.meshes.push_back(mesh_info(pointer, facts));
  report.meshes.back().payload_bytes = asset->payload_length;
  report.meshes.back().prefix_entries = asset->prefixes.size();
}

void validate_gltf(const std::filesystem::path& path, std::vector<std::uint8_t> file,
                   const ValidateOptions& options, ValidationReport& report) {
  GltfDocument document(path, std::move(file), report.issues);
  gltf::check_structure(document, report.issues);
  read_asset_info(document, report);
  const std::vector<std::size_t> meshes = gltf::progressive_meshes(document, report.issues);
  if (meshes.empty()) report.issues.push_back({IssueCode::extension_absent, "", ""});
  for (std::size_t mesh : meshes) validate_mesh(document, mesh, options, report);
}

bool starts_stream(std::span<const std::uint8_t> file) {
  return file.size() >= bitstream::kMagic.size() &&
         std::equal(bitstream::kMagic.begin(), bitstream::kMagic.end(), file.begin());
}

// JSON may begin with white space; no other format we know begins with a brace.
bool starts_json(std::span<const std::uint8_t> file) {
  const auto first = std::find_if(file.begin(), file.end(), [](std::uint8_t c) {
    return c != ' ' && c != '\n' && c != '\r' && c != '\t';
  });
  return first != file.end() && *first == '{';
}

}  // namespace

ValidationReport validate_file(const std::filesystem::path& path, const ValidateOptions& options) {
  ValidationReport report;
  report.uri = path.string();
  std::vector<std::uint8_t> file = gltf::read_file(path);
  try {
    if (starts_stream(file)) {
      report.mime_type = kStreamType;
      validate_stream(file, options, report);
    } else if (gltf::is_glb(file) || starts_json(file)) {
      report.mime_type = gltf::is_glb(file) ? kBinaryType : kJsonType;
      validate_gltf(path, std::move(file), options, report);
    } else {
      report.mime_type = kStreamType;
      report.issues.push_back({IssueCode::file_format_unknown, "", ""});
    }
  } catch (const IssueFound& found) {
    report.issues.push_back(found.issue());
  }
  gltf::remove_repeated(report.issues);
  return report;
}

}  // namespace zerotree::validate
