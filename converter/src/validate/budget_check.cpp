#include "validate/budget_check.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <set>
#include <string>
#include <system_error>

#include "gltf/percent_encoding.h"
#include "gltf/progressive_asset.h"

namespace zerotree::validate {
namespace {

namespace fs = std::filesystem;
using gltf::IssueCode;
using gltf::Issues;
using gltf::JsonCursor;

// A stated error is a decimal number of a few digits times a diagonal of a few digits.
constexpr double kRounding = 1e-6;

void count_named_file(const JsonCursor& uri, const fs::path& folder, std::set<fs::path>& counted,
                      std::uint64_t& bytes) {
  if (!uri.exists()) return;
  const std::string text = uri.string();
  if (text.starts_with("data:")) return;
  const fs::path file = (folder / gltf::percent_decoded(text)).lexically_normal();
  if (!counted.insert(file).second) return;
  std::error_code error;
  const std::uintmax_t size = fs::file_size(file, error);
  if (error)
    uri.fail(IssueCode::io_error,
             "the size of \"" + text + "\" counts and cannot be told: " + error.message());
  bytes += size;
}

void add_beyond(IssueCode code, const std::string& pointer, std::uint64_t value,
                std::uint64_t allowed, const char* unit, Issues& issues) {
  if (allowed == 0 || value <= allowed) return;
  issues.push_back(
      {code, pointer,
       std::to_string(value) + " " + unit + ", allowed are " + std::to_string(allowed)});
}

void check_error(double value, double allowed, const char* unit, const MeshInfo& mesh,
                 Issues& issues) {
  if (allowed == 0) return;
  char detail[100];
  std::snprintf(detail, sizeof detail, "%.4g%s, allowed is %.4g%s", value, unit, allowed, unit);
  const std::string table = mesh.pointer + "/extensions/" + gltf::kExtensionName + "/prefixes/";
  if (mesh.prefix_entries == 0)
    issues.push_back({IssueCode::budget_error_unknown, mesh.pointer, ""});
  else if (value > allowed * (1 + kRounding))
    issues.push_back({IssueCode::budget_error,
                      table + std::to_string(mesh.prefix_entries - 1) + "/geometricError", detail});
}

std::uint64_t all_triangles(const ValidationReport& report) {
  std::uint64_t sum = 0;
  for (const MeshInfo& mesh : report.meshes) {
    const std::uint64_t room = std::numeric_limits<std::uint64_t>::max() - sum;
    sum += std::min(room, mesh.finest_triangles);
  }
  return sum;
}

}  // namespace

std::uint64_t count_bytes(const gltf::GltfDocument& document, std::uint64_t file_bytes,
                          Issues& issues) {
  std::set<fs::path> counted{document.path().lexically_normal()};
  for (const char* list : {"buffers", "images"}) {
    const JsonCursor objects = document.root().member(list);
    for (std::size_t i = 0; i < objects.size(); ++i) {
      try {
        count_named_file(objects.element(i).member("uri"), document.path().parent_path(), counted,
                         file_bytes);
      } catch (const gltf::IssueFound& found) {
        issues.push_back(found.issue());
      }
    }
  }
  return file_bytes;
}

void check_budgets(const Budgets& budgets, ValidationReport& report) {
  add_beyond(IssueCode::budget_bytes, "", report.total_bytes, budgets.max_bytes, "bytes",
             report.issues);
  add_beyond(IssueCode::budget_triangles, "", all_triangles(report), budgets.max_triangles,
             "triangles", report.issues);
  for (const MeshInfo& mesh : report.meshes) {
    check_error(mesh.stated_error, budgets.max_error, "", mesh, report.issues);
    check_error(mesh.stated_error_metres, budgets.max_error_metres, " m", mesh, report.issues);
  }
}

}  // namespace zerotree::validate
