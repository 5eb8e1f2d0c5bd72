#include "validate/payload_check.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "bitstream/base_hash.h"
#include "bitstream/base_traversal.h"
#include "bitstream/stream_decoder.h"
#include "progressive/progressive_surface.h"

namespace zerotree::validate {
namespace {

using bitstream::BaseTopology;
using bitstream::DecodeStatus;
using bitstream::StreamDecoder;
using gltf::Issue;
using gltf::IssueCode;
using gltf::Issues;
using surface::ProgressiveSurface;

std::vector<float> flat(const std::vector<Eigen::Vector3f>& points) {
  std::vector<float> values;
  for (const Eigen::Vector3f& p : points) values.insert(values.end(), p.data(), p.data() + 3);
  return values;
}

// Euler's formula bounds it: a level has at most half as many new vertices as faces times three,
// and every level quadruples the faces.
std::uint64_t most_vertices(const BaseTopology& base, int levels) {
  return base.vertex_count + 2 * (std::uint64_t{base.triangles.size()} << (2 * levels));
}

// Limit positions at the vertices of the finest level. Throws std::invalid_argument if the base is
// no manifold.
std::vector<float> limit_positions(ProgressiveSurface& surface) {
  const int level = surface.levels();
  std::vector<float> limit(3 * surface.counts(level).vertices);
  if (surface.write_limits(level, {{limit.data()}, {}}) == surface::SurfaceOutcome::broken)
    throw std::invalid_argument(surface.reason());
  return limit;
}

// Rounding of two evaluations of the same surface differs by about 1e-7 of its size.
constexpr float kBoundsTolerance = 1e-5f;

void check_surface(const std::vector<float>& positions, const gltf::ProgressiveAsset* asset,
                   const std::string& pointer, Issues& issues) {
  const auto finite = [](float value) { return std::isfinite(value); };
  if (!std::all_of(positions.begin(), positions.end(), finite)) {
    issues.push_back({IssueCode::surface_not_finite, pointer, ""});
    return;
  }
  if (asset == nullptr) return;
  const float slack = kBoundsTolerance * (asset->bounds_max - asset->bounds_min).norm();
  float outside = 0;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const auto axis = static_cast<Eigen::Index>(i % 3);
    outside = std::max(
        {outside, asset->bounds_min[axis] - positions[i], positions[i] - asset->bounds_max[axis]});
  }
  if (outside > slack)
    issues.push_back(
        {IssueCode::surface_out_of_bounds, pointer, "by up to " + std::to_string(outside)});
}

void add_final_status(const ProgressiveSurface& surface, const std::string& pointer,
                      Issues& issues) {
  if (surface.status() == DecodeStatus::broken)
    issues.push_back({IssueCode::payload_broken, pointer, surface.reason()});
  if (surface.status() == DecodeStatus::more_bytes_wanted)
    issues.push_back({IssueCode::payload_incomplete, pointer, ""});
}

bool is_for_another_base(const StreamDecoder& decoder, const gltf::ProgressiveAsset& asset) {
  return decoder.header().base_hash != bitstream::hash_base(asset.base, flat(asset.control_points));
}

bool is_too_large(const BaseTopology& base, int levels, std::uint64_t max_vertices,
                  const std::string& pointer, Issues& issues) {
  const std::uint64_t count = most_vertices(base, levels);
  if (count <= max_vertices) return false;
  issues.push_back({IssueCode::payload_too_large, pointer,
                    "up to " + std::to_string(count) + " vertices, the limit is " +
                        std::to_string(max_vertices)});
  return true;
}

// Feeds the payload up to each entry of the table in turn and looks at the surface there. Returns
// the number of vertices it looked at in each.
std::uint64_t check_prefixes(const gltf::ProgressiveAsset& asset, const std::string& extension,
                             ProgressiveSurface& surface, Issues& issues) {
  std::uint64_t vertices = 0;
  const std::span<const std::uint8_t> payload = asset.payload;
  std::size_t fed = 0;
  for (std::size_t i = 0; i < asset.prefixes.size(); ++i) {
    const std::size_t end = std::min<std::uint64_t>(payload.size(), asset.prefixes[i].byte_length);
    surface.feed(payload.subspan(fed, end - fed));
    fed = end;
    if (!surface.is_ready()) return vertices;
    const std::vector<float> positions = limit_positions(surface);
    vertices = positions.size() / 3;
    check_surface(positions, &asset, extension + "/prefixes/" + std::to_string(i), issues);
  }
  surface.feed(payload.subspan(fed));
  return vertices;
}

}  // namespace

PayloadFacts check_payload(const gltf::ProgressiveAsset& asset, const std::string& mesh,
                           std::uint64_t max_vertices, Issues& issues) {
  const std::string extension = mesh + "/extensions/" + gltf::kExtensionName;
  const std::string payload = extension + "/bufferView";
  PayloadFacts facts{asset.levels, asset.base.vertex_count, asset.base.triangles.size(), 0, 0};
  if (is_too_large(asset.base, asset.levels, max_vertices, extension + "/levels", issues))
    return facts;
  const bitstream::ConnectivityStatus base_status = bitstream::check_base_topology(asset.base);
  if (!base_status.ok()) {
    issues.push_back({IssueCode::base_unsupported, mesh, base_status.problem});
    return facts;
  }
  bitstream::Limits limits;
  limits.max_vertices = max_vertices;
  ProgressiveSurface surface({asset.base, flat(asset.control_points), asset.levels}, limits);
  const StreamDecoder& decoder = surface.decoder();
  try {
    facts.finest_vertices = check_prefixes(asset, extension, surface, issues);
  } catch (const std::invalid_argument& error) {
    issues.push_back({IssueCode::base_unsupported, mesh, error.what()});
    return facts;
  }
  facts.bytes_decoded = decoder.bytes_consumed();
  const bool has_header = decoder.header_ready();
  const bool has_other_base = has_header && is_for_another_base(decoder, asset);
  const bool has_other_levels = has_header && decoder.header().levels != asset.levels;
  if (has_other_base) issues.push_back({IssueCode::payload_base_mismatch, payload, ""});
  if (has_other_levels)
    issues.push_back(
        {IssueCode::payload_levels_mismatch, extension + "/levels",
         std::to_string(asset.levels) + " and " + std::to_string(decoder.header().levels)});
  if (!has_other_base && !has_other_levels) add_final_status(surface, payload, issues);
  return facts;
}

PayloadFacts check_stream(std::span<const std::uint8_t> stream, std::uint64_t max_vertices,
                          Issues& issues) {
  bitstream::Limits limits;
  limits.max_vertices = max_vertices;
  ProgressiveSurface surface(limits);
  surface.feed(stream);
  const StreamDecoder& decoder = surface.decoder();
  PayloadFacts facts;
  facts.bytes_decoded = decoder.bytes_consumed();
  add_final_status(surface, "", issues);
  if (!surface.is_ready()) return facts;
  const BaseTopology& base = decoder.base();
  facts.levels = decoder.header().levels;
  facts.base_vertices = base.vertex_count;
  facts.base_triangles = base.triangles.size();
  if (is_too_large(base, facts.levels, max_vertices, "", issues)) return facts;
  const std::vector<float> positions = limit_positions(surface);
  facts.finest_vertices = positions.size() / 3;
  check_surface(positions, nullptr, "", issues);
  return facts;
}

}  // namespace zerotree::validate
