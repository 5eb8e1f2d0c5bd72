#include "validate/payload_check.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <vector>

#include "bitstream/base_hash.h"
#include "bitstream/base_traversal.h"
#include "bitstream/stream_decoder.h"
#include "surface/surface_synthesis.h"

namespace zerotree::validate {
namespace {

using bitstream::BaseTopology;
using bitstream::DecodeStatus;
using bitstream::StreamDecoder;
using gltf::Issue;
using gltf::IssueCode;
using gltf::Issues;

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

// The surfaces of one payload. The hierarchy is built once for the base without sharp tags, which
// is all that a prefix too short for them has, and again if the stream then brings tags.
class SurfaceMaker {
 public:
  SurfaceMaker(BaseTopology base, std::vector<float> positions, int levels)
      : base_(std::move(base)), positions_(std::move(positions)), levels_(levels) {}

  /// Limit positions at the vertices of the finest level. Throws std::invalid_argument if the base
  /// is no manifold.
  std::vector<float> limit_positions(const StreamDecoder& decoder);

 private:
  void use_hierarchy_of(const BaseTopology& base, surface::WaveletTransform transform);

  BaseTopology base_;
  std::vector<float> positions_;
  int levels_;
  std::unique_ptr<surface::SubdivisionHierarchy> hierarchy_;
};

void SurfaceMaker::use_hierarchy_of(const BaseTopology& base, surface::WaveletTransform transform) {
  if (hierarchy_ != nullptr && hierarchy_->base().crease_edges == base.crease_edges &&
      hierarchy_->base().corner_vertices == base.corner_vertices)
    return;
  hierarchy_.reset();
  hierarchy_ = std::make_unique<surface::SubdivisionHierarchy>(base, levels_, transform);
}

std::vector<float> SurfaceMaker::limit_positions(const StreamDecoder& decoder) {
  bitstream::CoefficientSet nothing;
  surface::Dequantisation dequantisation;
  const bitstream::CoefficientSet* coefficients = &nothing;
  if (decoder.base_ready()) {
    dequantisation.transform = static_cast<surface::WaveletTransform>(decoder.header().transform);
    use_hierarchy_of(decoder.base(), dequantisation.transform);
    positions_ = decoder.base_positions();
    coefficients = &decoder.coefficients();
    dequantisation.step = decoder.header().finest_step;
    dequantisation.tangent_ratio = std::ldexp(1.0f, decoder.header().tangent_ratio_log2);
  } else {
    // Without details the transform does not matter: there is only Loop subdivision.
    use_hierarchy_of(base_, dequantisation.transform);
    nothing.base_edge_count = hierarchy_->base_edges().size();
  }
  const surface::Positions control_points =
      surface::reconstruct(*hierarchy_, positions_, *coefficients, dequantisation, levels_);
  std::vector<float> limit(control_points.size());
  surface::limit_surface(hierarchy_->level(levels_), control_points, {limit.data()}, {});
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

void add_final_status(const StreamDecoder& decoder, const std::string& pointer, Issues& issues) {
  if (decoder.status() == DecodeStatus::broken)
    issues.push_back({IssueCode::payload_broken, pointer, decoder.reason()});
  if (decoder.status() == DecodeStatus::more_bytes_wanted)
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
                             StreamDecoder& decoder, Issues& issues) {
  std::uint64_t vertices = 0;
  SurfaceMaker surfaces(asset.base, flat(asset.control_points), asset.levels);
  const std::span<const std::uint8_t> payload = asset.payload;
  std::size_t fed = 0;
  for (std::size_t i = 0; i < asset.prefixes.size(); ++i) {
    const std::size_t end = std::min<std::uint64_t>(payload.size(), asset.prefixes[i].byte_length);
    const DecodeStatus status = decoder.feed(payload.subspan(fed, end - fed));
    fed = end;
    if (status == DecodeStatus::broken) return vertices;
    if (decoder.header_ready() && decoder.header().levels != asset.levels) return vertices;
    const std::vector<float> positions = surfaces.limit_positions(decoder);
    vertices = positions.size() / 3;
    check_surface(positions, &asset, extension + "/prefixes/" + std::to_string(i), issues);
  }
  decoder.feed(payload.subspan(fed));
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
  StreamDecoder decoder(asset.base, flat(asset.control_points), limits);
  try {
    facts.finest_vertices = check_prefixes(asset, extension, decoder, issues);
  } catch (const std::invalid_argument& error) {
    issues.push_back({IssueCode::base_unsupported, mesh, error.what()});
    return facts;
  }
  facts.bytes_decoded = decoder.bytes_consumed();
  const bool has_header = decoder.header_ready();
  if (has_header && is_for_another_base(decoder, asset))
    issues.push_back({IssueCode::payload_base_mismatch, payload, ""});
  else
    add_final_status(decoder, payload, issues);
  if (has_header && decoder.header().levels != asset.levels)
    issues.push_back(
        {IssueCode::payload_levels_mismatch, extension + "/levels",
         std::to_string(asset.levels) + " and " + std::to_string(decoder.header().levels)});
  return facts;
}

PayloadFacts check_stream(std::span<const std::uint8_t> stream, std::uint64_t max_vertices,
                          Issues& issues) {
  bitstream::Limits limits;
  limits.max_vertices = max_vertices;
  StreamDecoder decoder(limits);
  decoder.feed(stream);
  PayloadFacts facts;
  facts.bytes_decoded = decoder.bytes_consumed();
  add_final_status(decoder, "", issues);
  if (decoder.status() == DecodeStatus::broken || !decoder.base_ready()) return facts;
  const BaseTopology& base = decoder.base();
  facts.levels = decoder.header().levels;
  facts.base_vertices = base.vertex_count;
  facts.base_triangles = base.triangles.size();
  if (is_too_large(base, facts.levels, max_vertices, "", issues)) return facts;
  SurfaceMaker surfaces(base, decoder.base_positions(), facts.levels);
  const std::vector<float> positions = surfaces.limit_positions(decoder);
  facts.finest_vertices = positions.size() / 3;
  check_surface(positions, nullptr, "", issues);
  return facts;
}

}  // namespace zerotree::validate
