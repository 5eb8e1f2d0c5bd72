#include "validate/payload_check.h"

#include <tbb/info.h>
#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <functional>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>

#include "bitstream/base_edges.h"
#include "bitstream/base_hash.h"
#include "bitstream/base_traversal.h"
#include "bitstream/stream_decoder.h"
#include "bitstream/stream_header.h"
#include "progressive/progressive_surface.h"
#include "validate/prefix_plan.h"
#include "validate/seam_check.h"
#include "validate/surface_findings.h"

namespace zerotree::validate {
namespace {

using bitstream::BaseTopology;
using bitstream::DecodeStatus;
using gltf::IssueCode;
using gltf::Issues;
using gltf::ProgressiveAsset;
using surface::LevelCounts;
using surface::ProgressiveSurface;

// Between two reports of progress.
constexpr std::size_t kPieceBytes = std::size_t{1} << 20;
// A base mesh lies around its surface, and not far around.
constexpr double kMostDiagonalRatio = 4;

using Look = std::function<void(const Checkpoint&, std::span<const float>)>;

std::vector<float> flat(const std::vector<Eigen::Vector3f>& points) {
  std::vector<float> values;
  values.reserve(3 * points.size());
  for (const Eigen::Vector3f& p : points) values.insert(values.end(), p.data(), p.data() + 3);
  return values;
}

std::string extension_of(const MeshPlace& place) {
  return place.mesh + "/extensions/" + gltf::kExtensionName;
}

bitstream::Limits limits_of(const ValidateOptions& options) {
  // Of the decoder's state; base vertices take the most. So vertices alone decide.
  constexpr std::uint64_t kMemoryPerVertex = 1024;
  bitstream::Limits limits;
  limits.max_vertices = options.max_vertices;
  limits.max_memory = kMemoryPerVertex * options.max_vertices;
  return limits;
}

// Surfaces are made on all of the machine's threads; they do not depend on that.
surface::SurfaceResources parallel() {
  surface::SurfaceResources resources;
  resources.jobs.run = [](void*, std::uint32_t count, surface::Jobs::Task task, void* context) {
    tbb::parallel_for(std::uint32_t{0}, count, [&](std::uint32_t i) { task(context, i); });
  };
  resources.jobs.threads = static_cast<std::uint32_t>(tbb::info::default_concurrency());
  return resources;
}

bool is_too_large(std::uint64_t vertices, const ValidateOptions& options,
                  const std::string& pointer, Issues& issues) {
  if (vertices <= options.max_vertices) return false;
  issues.push_back({IssueCode::payload_too_large, pointer,
                    std::to_string(vertices) + " vertices, the limit is " +
                        std::to_string(options.max_vertices)});
  return true;
}

void feed_reporting(ProgressiveSurface& surface, std::span<const std::uint8_t> bytes,
                    std::size_t before, std::size_t all, const Progress& progress) {
  while (!bytes.empty()) {
    report_progress(progress, "decoding", static_cast<double>(before) / static_cast<double>(all));
    const auto piece = bytes.first(std::min(bytes.size(), kPieceBytes));
    surface.feed(piece);
    before += piece.size();
    bytes = bytes.subspan(piece.size());
  }
}

// Feeds the payload from checkpoint to checkpoint and shows the finest surface at each that has
// one. Throws std::invalid_argument if the base is no manifold.
void walk_prefixes(ProgressiveSurface& surface, std::span<const std::uint8_t> payload,
                   const std::vector<Checkpoint>& checkpoints, const Progress& progress,
                   const Look& look) {
  std::vector<float> limits;
  std::size_t fed = 0;
  for (const Checkpoint& checkpoint : checkpoints) {
    feed_reporting(surface, payload.subspan(fed, checkpoint.bytes - fed), fed, payload.size(),
                   progress);
    fed = checkpoint.bytes;
    if (!surface.is_ready()) continue;
    const int level = surface.levels();
    limits.resize(3 * surface.counts(level).vertices);
    if (surface.write_limits(level, {{limits.data()}, {}}) == surface::SurfaceOutcome::broken)
      throw std::invalid_argument(surface.reason());
    look(checkpoint, limits);
  }
}

void add_final_status(const ProgressiveSurface& surface, std::uint64_t payload_bytes,
                      const std::string& pointer, Issues& issues) {
  if (surface.status() == DecodeStatus::broken)
    issues.push_back({IssueCode::payload_broken, pointer, surface.reason()});
  if (surface.status() == DecodeStatus::more_bytes_wanted)
    issues.push_back({IssueCode::payload_incomplete, pointer, ""});
  const std::uint64_t end = surface.decoder().bytes_consumed();
  if (surface.status() == DecodeStatus::done && end < payload_bytes)
    issues.push_back(
        {IssueCode::payload_trailing_bytes, pointer,
         "it ends after " + std::to_string(end) + " of " + std::to_string(payload_bytes)});
}

// The last entry names the payload's end, whatever its bytes are good for.
void check_entries_in_stream(const ProgressiveSurface& surface,
                             const std::vector<gltf::PrefixEntry>& entries,
                             const std::string& extension, Issues& issues) {
  const std::uint64_t end = surface.decoder().bytes_consumed();
  if (surface.status() != DecodeStatus::done) return;
  for (std::size_t i = 0; i + 1 < entries.size(); ++i) {
    if (entries[i].byte_length <= end) continue;
    issues.push_back({IssueCode::prefix_beyond_stream,
                      extension + "/prefixes/" + std::to_string(i) + "/byteLength",
                      std::to_string(entries[i].byte_length) + ", the stream has " +
                          std::to_string(end) + " bytes"});
    return;
  }
}

void check_diagonal(const ProgressiveAsset& asset, const std::string& extension, Issues& issues) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3f& p : asset.control_points) box.extend(p.cast<double>());
  const double base = box.diagonal().norm();
  if (asset.source_diagonal <= kMostDiagonalRatio * base &&
      base <= kMostDiagonalRatio * asset.source_diagonal)
    return;
  issues.push_back({IssueCode::source_diagonal_implausible, extension + "/sourceDiagonal",
                    std::to_string(asset.source_diagonal) + ", the base mesh's diagonal is " +
                        std::to_string(base)});
}

// Whether the header is for this base and this many levels, if there is one.
bool check_header(const ProgressiveSurface& surface, int levels, std::uint32_t base_hash,
                  const std::string& extension, Issues& issues) {
  if (!surface.decoder().header_ready()) return true;
  const bitstream::StreamHeader& header = surface.decoder().header();
  if (header.base_hash != base_hash)
    issues.push_back({IssueCode::payload_base_mismatch, extension + "/bufferView", ""});
  if (header.levels != levels)
    issues.push_back({IssueCode::payload_levels_mismatch, extension + "/levels",
                      std::to_string(levels) + " and " + std::to_string(header.levels)});
  return header.base_hash == base_hash && header.levels == levels;
}

// Why the base is no oriented 2-manifold; empty if it is one.
std::string base_problem(const BaseTopology& base, const bitstream::BaseEdges& numbered) {
  if (!numbered.error.empty()) return numbered.error;
  const bitstream::ConnectivityStatus fans = bitstream::check_base_fans(base, numbered.edges);
  return fans.ok() ? "" : fans.problem;
}

// The base as it is before any byte of the payload is decoded.
struct KnownBase {
  LevelCounts counts;
  std::vector<float> positions;
  SeamCheck seams;
};

// Empty if nothing can be decoded over this base.
std::optional<KnownBase> know_base(const ProgressiveAsset& asset, const MeshPlace& place,
                                   const ValidateOptions& options, Issues& issues) {
  const std::string levels = extension_of(place) + "/levels";
  const std::uint64_t faces = asset.base.triangles.size();
  // Every edge has one or two faces: what is far too large costs nothing.
  const LevelCounts fewest{asset.base.vertex_count, (3 * faces + 1) / 2, faces};
  if (is_too_large(surface::refined_counts(fewest, asset.levels).vertices, options, levels, issues))
    return std::nullopt;
  const bitstream::BaseEdges numbered = bitstream::number_base_edges(asset.base);
  const std::string problem = base_problem(asset.base, numbered);
  if (!problem.empty()) {
    issues.push_back({IssueCode::base_unsupported, place.mesh, problem});
    return std::nullopt;
  }
  const LevelCounts counts{asset.base.vertex_count, numbered.edges.size(), faces};
  if (is_too_large(surface::refined_counts(counts, asset.levels).vertices, options, levels, issues))
    return std::nullopt;
  std::vector<float> positions = flat(asset.control_points);
  SeamCheck seams(numbered.edges, counts, positions, place.primitive_ends, asset.levels);
  return KnownBase{counts, std::move(positions), std::move(seams)};
}

PrefixPlan plan_for(const ProgressiveAsset& asset, std::uint64_t vertices, const MeshPlace& place,
                    const ValidateOptions& options, Issues& issues) {
  const std::uint64_t cost = surface_cost(asset.base.vertex_count, vertices);
  PrefixPlan plan = plan_prefixes(asset.payload, asset.prefixes, options.random_prefixes,
                                  cost * place.meshes_in_file);
  if (plan.entries_left_out > 0)
    issues.push_back({IssueCode::prefixes_sampled, extension_of(place) + "/prefixes",
                      std::to_string(asset.prefixes.size() - plan.entries_left_out) + " of " +
                          std::to_string(asset.prefixes.size())});
  return plan;
}

// What the finest level of an elementary stream has at least, by its header; zeros if there is
// none.
struct CountsByHeader {
  std::uint64_t base_vertices = 0;
  LevelCounts finest;
};

CountsByHeader counts_by_header(std::span<const std::uint8_t> stream) {
  constexpr std::uint64_t kUnlimited = std::numeric_limits<std::uint64_t>::max();
  bitstream::StreamHeader header;
  const bitstream::HeaderResult result =
      bitstream::read_header(stream, {kUnlimited, bitstream::kMostLevels, kUnlimited}, header);
  if (result.status != DecodeStatus::done || header.external_base) return {};
  const std::uint64_t faces = header.face_count;
  return {
      header.vertex_count,
      surface::refined_counts({header.vertex_count, (3 * faces + 1) / 2, faces}, header.levels)};
}

SeamCheck embedded_seams(const ProgressiveSurface& surface) {
  return SeamCheck(surface.decoder().base_edges(), surface.counts(0),
                   surface.decoder().base_positions(), {}, surface.levels());
}

}  // namespace

PayloadFacts check_payload(ProgressiveAsset asset, const MeshPlace& place,
                           const ValidateOptions& options, const Progress& progress,
                           Issues& issues) {
  const std::string extension = extension_of(place);
  const int levels = asset.levels;
  PayloadFacts facts{levels, asset.base.vertex_count, asset.base.triangles.size(), 0, 0, 0};
  facts.finest_triangles = facts.base_triangles << (2 * levels);
  check_diagonal(asset, extension, issues);
  std::optional<KnownBase> known = know_base(asset, place, options, issues);
  if (!known) return facts;
  const std::uint64_t vertices = surface::refined_counts(known->counts, levels).vertices;
  const std::uint32_t base_hash = bitstream::hash_base(asset.base, known->positions);
  const PrefixPlan plan = plan_for(asset, vertices, place, options, issues);
  std::vector<Eigen::Vector3f>().swap(asset.control_points);
  ProgressiveSurface surface({std::move(asset.base), std::move(known->positions), levels},
                             limits_of(options), parallel());
  const StatedSurface stated{
      extension, place.mesh, {asset.bounds_min, asset.bounds_max}, asset.source_diagonal};
  SurfaceFindings findings(&stated);
  findings.watch(known->seams);
  try {
    walk_prefixes(surface, asset.payload, plan.checkpoints, progress,
                  [&](const Checkpoint& checkpoint, std::span<const float> limits) {
                    facts.finest_vertices = vertices;
                    findings.look_at(checkpoint, limits);
                  });
  } catch (const std::invalid_argument& error) {
    issues.push_back({IssueCode::base_unsupported, place.mesh, error.what()});
    return facts;
  }
  facts.prefixes_decoded = findings.surfaces();
  const bool is_whole =
      surface.status() != DecodeStatus::broken && asset.payload.size() == asset.payload_length;
  findings.add_issues(is_whole, issues);
  if (!check_header(surface, levels, base_hash, extension, issues)) return facts;
  add_final_status(surface, asset.payload.size(), extension + "/bufferView", issues);
  check_entries_in_stream(surface, asset.prefixes, extension, issues);
  return facts;
}

PayloadFacts check_stream(std::span<const std::uint8_t> stream, const ValidateOptions& options,
                          const Progress& progress, Issues& issues) {
  PayloadFacts facts;
  const CountsByHeader least = counts_by_header(stream);
  if (is_too_large(least.finest.vertices, options, "", issues)) {
    facts.finest_triangles = least.finest.triangles;
    return facts;
  }
  ProgressiveSurface surface(limits_of(options), parallel());
  const PrefixPlan plan = plan_prefixes(stream, {}, options.random_prefixes,
                                        surface_cost(least.base_vertices, least.finest.vertices));
  std::optional<SeamCheck> seams;
  SurfaceFindings findings(nullptr);
  try {
    walk_prefixes(surface, stream, plan.checkpoints, progress,
                  [&](const Checkpoint& checkpoint, std::span<const float> limits) {
                    if (checkpoint.bytes == stream.size())
                      findings.watch(seams.emplace(embedded_seams(surface)));
                    findings.look_at(checkpoint, limits);
                  });
  } catch (const std::invalid_argument&) {
    // The surface is broken now and says why.
  }
  add_final_status(surface, stream.size(), "", issues);
  findings.add_issues(surface.status() != DecodeStatus::broken, issues);
  facts.prefixes_decoded = findings.surfaces();
  if (!surface.is_ready()) return facts;
  facts.levels = surface.levels();
  facts.base_vertices = surface.base().vertex_count;
  facts.base_triangles = surface.base().triangles.size();
  const LevelCounts finest = surface.counts(facts.levels);
  facts.finest_vertices = finest.vertices;
  facts.finest_triangles = finest.triangles;
  return facts;
}

}  // namespace zerotree::validate
