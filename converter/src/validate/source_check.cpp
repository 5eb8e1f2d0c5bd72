#include "validate/source_check.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "decode/prefix_surface.h"
#include "decode/stream_file.h"
#include "gltf/progressive_asset.h"
#include "measure/surface_distance.h"
#include "mesh/error.h"

namespace zerotree::validate {
namespace {

using gltf::IssueCode;

constexpr std::size_t kMostMeasured = 32;
// What convert's tables are made with, and what `compare` takes: see convert::Precision.
constexpr std::size_t kQuickSamples = 50'000, kExactSamples = 1'000'000;
constexpr double kUnderstated = 1.03, kOverstated = 1.25;
// A quick measurement is not farther off than this.
constexpr double kDoubtful = 1.3;
constexpr double kDiagonalTolerance = 1e-3;

// An entry of the table and its measured error. Lengths are those of the source, in place.
struct Measurement {
  std::size_t entry;
  double stated, measured;
};

double distance(const measure::SurfaceIndex& source, const TriangleMesh& surface,
                std::size_t samples) {
  return measure::compare_surfaces(source, surface, {.samples = samples}).symmetric.rms;
}

// Of `count` entries at most kMostMeasured, the last one among them.
std::vector<std::size_t> measured_entries(std::size_t count) {
  const std::size_t taken = std::min(count, kMostMeasured);
  std::vector<std::size_t> entries(taken);
  for (std::size_t k = 0; k < taken; ++k) entries[taken - 1 - k] = count - 1 - k * count / taken;
  return entries;
}

std::vector<Measurement> measure_table(const decode::StreamFile& file,
                                       const measure::SurfaceIndex& source,
                                       const Progress& progress) {
  std::vector<Measurement> measurements;
  decode::PrefixSurface prefix(file);
  const std::vector<std::size_t> entries = measured_entries(file.prefixes.size());
  for (const std::size_t entry : entries) {
    report_progress(progress, "measuring prefixes",
                    static_cast<double>(measurements.size()) / static_cast<double>(entries.size()));
    const double stated = file.prefixes[entry].error * file.source_diagonal;
    prefix.advance_to(file.prefixes[entry].bytes);
    const TriangleMesh surface = decode::to_triangle_mesh(prefix.surface());
    double measured = distance(source, surface, kQuickSamples);
    if (measured > kUnderstated * stated && measured < kDoubtful * stated)
      measured = distance(source, surface, kExactSamples);
    measurements.push_back({entry, stated, measured});
  }
  return measurements;
}

void add_issue(IssueCode code, const std::string& pointer, double stated, double measured,
               ValidationReport& report) {
  char detail[100];
  std::snprintf(detail, sizeof detail, "%.4g, measured is %.4g", stated, measured);
  report.issues.push_back({code, pointer, detail});
}

// `scale`: of the mesh's unit, in which the file states lengths.
void judge(const std::vector<Measurement>& measurements, double scale, const std::string& extension,
           ValidationReport& report) {
  const auto before = static_cast<std::ptrdiff_t>(report.issues.size());
  double largest = 0;  // of the entry at hand and all later ones
  for (auto m = measurements.rbegin(); m != measurements.rend(); ++m) {
    largest = std::max(largest, m->measured);
    const std::string place =
        extension + "/prefixes/" + std::to_string(m->entry) + "/geometricError";
    if (m->measured > kUnderstated * m->stated)
      add_issue(IssueCode::prefix_error_understated, place, m->stated / scale, m->measured / scale,
                report);
    else if (m->stated > kOverstated * largest)
      add_issue(IssueCode::prefix_error_overstated, place, m->stated / scale, largest / scale,
                report);
  }
  std::reverse(report.issues.begin() + before, report.issues.end());
}

}  // namespace

void check_source(const std::filesystem::path& path, const SourceScan& source,
                  const Progress& progress, ValidationReport& report) {
  // Of a file that cannot be read to its end, the number of meshes says nothing.
  if (gltf::first_error(report.issues) != nullptr) {
    report.issues.push_back({IssueCode::source_not_measured, "", ""});
    return;
  }
  if (report.progressive_meshes != 1)
    throw Error(ExitCode::usage, path.string() + ": has " +
                                     std::to_string(report.progressive_meshes) +
                                     " progressive meshes: name a file with one to measure it "
                                     "against its source");
  const decode::StreamFile file = decode::open_stream_file(path);
  if (file.prefixes.empty())
    throw Error(ExitCode::usage, path.string() +
                                     ": has no table of errors to compare with its "
                                     "source: name the glTF file, which has one");
  MeshInfo& mesh = report.meshes.front();
  const std::string extension = mesh.pointer + "/extensions/" + gltf::kExtensionName;
  const double scale = file.placement.scale;
  if (std::abs(file.source_diagonal - source.diagonal) > kDiagonalTolerance * source.diagonal)
    add_issue(IssueCode::source_diagonal_mismatch, extension + "/sourceDiagonal",
              file.source_diagonal / scale, source.diagonal / scale, report);
  const std::vector<Measurement> measurements = measure_table(file, source.surface, progress);
  for (const Measurement& m : measurements)
    mesh.measured.push_back({file.prefixes[m.entry].bytes, m.stated / scale, m.measured / scale});
  judge(measurements, scale, extension, report);
}

}  // namespace zerotree::validate
