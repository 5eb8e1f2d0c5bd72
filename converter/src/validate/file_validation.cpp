#include "validate/file_validation.h"

#include <algorithm>
#include <chrono>
#include <optional>
#include <span>
#include <utility>

#include "bitstream/stream_header.h"
#include "gltf/glb_container.h"
#include "gltf/progressive_reader.h"
#include "gltf/structure_check.h"
#include "validate/budget_check.h"
#include "validate/payload_check.h"
#include "validate/source_check.h"

namespace zerotree::validate {
namespace {

using gltf::GltfDocument;
using gltf::IssueCode;
using gltf::IssueFound;
using gltf::JsonCursor;

constexpr const char* kBinaryType = "model/gltf-binary";
constexpr const char* kJsonType = "model/gltf+json";
constexpr const char* kStreamType = "application/octet-stream";

MeshInfo mesh_info(std::string pointer, const PayloadFacts& facts, std::uint64_t payload_bytes) {
  MeshInfo info;
  info.pointer = std::move(pointer);
  info.levels = facts.levels;
  info.base_vertices = facts.base_vertices;
  info.base_triangles = facts.base_triangles;
  info.finest_vertices = facts.finest_vertices;
  info.finest_triangles = facts.finest_triangles;
  info.payload_bytes = payload_bytes;
  info.prefixes_decoded = facts.prefixes_decoded;
  return info;
}

void validate_stream(std::span<const std::uint8_t> file, const ValidateOptions& options,
                     const Progress& progress, ValidationReport& report) {
  report.progressive_meshes = 1;
  report.total_bytes = options.budgets.max_bytes > 0 ? file.size() : 0;
  const PayloadFacts facts = check_stream(file, options, progress, report.issues);
  report.meshes.push_back(mesh_info("", facts, file.size()));
}

void read_asset_info(const GltfDocument& document, ValidationReport& report) {
  const JsonCursor asset = document.root().member("asset");
  report.version = asset.member("version").string();
  const JsonCursor generator = asset.member("generator");
  if (generator.exists() && generator.value().is_string()) report.generator = generator.string();
  const JsonCursor used = document.root().member("extensionsUsed");
  for (std::size_t i = 0; i < used.size(); ++i)
    if (used.element(i).value().is_string())
      report.extensions_used.push_back(used.element(i).string());
}

// Of a mesh that has been read.
std::vector<std::uint64_t> primitive_ends(const GltfDocument& document, std::size_t mesh) {
  const JsonCursor root = document.root();
  const JsonCursor primitives = root.member("meshes").element(mesh).member("primitives");
  std::vector<std::uint64_t> ends;
  std::uint64_t end = 0;
  for (std::size_t i = 0; i < primitives.size(); ++i) {
    const JsonCursor indices = primitives.element(i).member("indices");
    end += root.member("accessors")
               .element(indices.unsigned_integer())
               .member("count")
               .unsigned_integer() /
           3;
    ends.push_back(end);
  }
  return ends;
}

// A mesh taken out of its file.
struct ReadMesh {
  MeshPlace place;
  gltf::ProgressiveAsset asset;
};

void validate_mesh(ReadMesh mesh, const ValidateOptions& options, const Progress& progress,
                   ValidationReport& report) {
  gltf::ProgressiveAsset& asset = mesh.asset;
  const std::uint64_t payload_bytes = asset.payload_length, entries = asset.prefixes.size();
  const double stated = asset.prefixes.back().geometric_error;
  const double diagonal = asset.source_diagonal, scale = asset.placement.scale;
  const PayloadFacts facts =
      check_payload(std::move(asset), mesh.place, options, progress, report.issues);
  MeshInfo& info = report.meshes.emplace_back(mesh_info(mesh.place.mesh, facts, payload_bytes));
  info.prefix_entries = entries;
  info.stated_error = stated / diagonal;
  info.stated_error_metres = stated * scale;
}

// Of nodes that are not as glTF has them the structure check tells.
std::vector<gltf::Placement> placements_of(const GltfDocument& document) {
  try {
    return gltf::mesh_placements(document);
  } catch (const IssueFound&) {
    return std::vector<gltf::Placement>(document.root().member("meshes").size());
  }
}

void validate_gltf(const std::filesystem::path& path, std::vector<std::uint8_t> file,
                   const ValidateOptions& options, const Progress& progress,
                   ValidationReport& report) {
  const std::uint64_t file_bytes = file.size();
  std::optional<GltfDocument> document(std::in_place, path, std::move(file), report.issues);
  gltf::check_structure(*document, report.issues);
  read_asset_info(*document, report);
  if (options.budgets.max_bytes > 0)
    report.total_bytes = count_bytes(*document, file_bytes, report.issues);
  const std::vector<std::size_t> meshes = gltf::progressive_meshes(*document, report.issues);
  report.progressive_meshes = meshes.size();
  if (meshes.empty()) report.issues.push_back({IssueCode::extension_absent, "", ""});
  const std::vector<gltf::Placement> placements = placements_of(*document);
  for (const std::size_t mesh : meshes) {
    std::optional<gltf::ProgressiveAsset> asset = gltf::read_mesh(*document, mesh, report.issues);
    std::vector<std::uint64_t> ends;
    if (asset) {
      asset->placement = placements[mesh];
      ends = primitive_ends(*document, mesh);
    }
    // A mesh has copied what it needs: the last one is decoded without the file in memory.
    if (mesh == meshes.back()) document.reset();
    if (asset)
      validate_mesh(
          {{"/meshes/" + std::to_string(mesh), std::move(ends), meshes.size()}, std::move(*asset)},
          options, progress, report);
  }
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

// What is wrong is an issue; throws nothing else.
void check_content(const std::filesystem::path& path, std::vector<std::uint8_t> file,
                   const ValidateOptions& options, const Progress& progress,
                   ValidationReport& report) {
  try {
    if (starts_stream(file)) {
      report.mime_type = kStreamType;
      validate_stream(file, options, progress, report);
    } else if (gltf::is_glb(file) || starts_json(file)) {
      report.mime_type = gltf::is_glb(file) ? kBinaryType : kJsonType;
      validate_gltf(path, std::move(file), options, progress, report);
    } else {
      report.issues.push_back({IssueCode::file_format_unknown, "", ""});
    }
  } catch (const IssueFound& found) {
    report.issues.push_back(found.issue());
  }
}

}  // namespace

ValidationReport validate_file(const std::filesystem::path& path, const ValidateOptions& options,
                               const Progress& progress) {
  const auto start = std::chrono::steady_clock::now();
  ValidationReport report;
  report.uri = path.string();
  check_content(path, gltf::read_file(path), options, progress, report);
  gltf::remove_repeated(report.issues);
  if (options.source != nullptr) check_source(path, *options.source, progress, report);
  check_budgets(options.budgets, report);
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return report;
}

ValidationReport unreadable_report(const std::filesystem::path& path, const std::string& why) {
  ValidationReport report;
  report.uri = path.string();
  report.is_unreadable = true;
  report.issues.push_back({IssueCode::io_error, "", why});
  return report;
}

}  // namespace zerotree::validate
