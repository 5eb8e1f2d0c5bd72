#include "encoded_assets.h"

#include <Eigen/Geometry>
#include <cmath>
#include <span>
#include <utility>

#include "bitstream/base_edges.h"
#include "bitstream/base_traversal.h"
#include "encode/encode.h"
#include "progressive/progressive_surface.h"
#include "sample_assets.h"

namespace zerotree::test {
namespace {

constexpr int kLevels = 2;

bitstream::BaseTopology topology_of(const Shape& shape) {
  bitstream::BaseTopology base;
  base.vertex_count = static_cast<std::uint32_t>(shape.mesh.positions.size());
  base.triangles = shape.mesh.triangles;
  base.crease_edges = shape.crease_edges;
  base.corner_vertices = shape.corner_vertices;
  return base;
}

analysis::WaveletDecomposition small_details(const bitstream::BaseTopology& base,
                                             std::vector<Eigen::Vector3d> control_points,
                                             double scale) {
  analysis::WaveletDecomposition decomposition;
  decomposition.base_control_points = std::move(control_points);
  std::size_t edges = bitstream::number_base_edges(base).edges.size();
  std::size_t faces = base.triangles.size();
  for (int level = 0; level < kLevels; ++level) {
    auto& details = decomposition.details.emplace_back(edges, Eigen::Vector3d::Zero());
    for (std::size_t e = 0; e < edges; ++e) {
      const double phase = static_cast<double>(e) * 0.7;
      details[e] =
          scale * std::ldexp(0.02, -2 * level) *
          Eigen::Vector3d(std::sin(phase), 0.3 * std::cos(phase), 0.2 * std::sin(3 * phase));
    }
    edges = 2 * edges + 3 * faces;
    faces *= 4;
  }
  return decomposition;
}

encode::EncodeOptions options(bool embed_base, double scale) {
  encode::EncodeOptions options;
  options.finest_step = scale * 1e-3;
  options.embed_base = embed_base;
  return options;
}

std::vector<std::uint8_t> payload_of(const gltf::ProgressiveAsset& asset, const Shape& shape,
                                     double detail_scale) {
  const bitstream::BaseTopology base = topology_of(shape);
  // The stream is bound to the positions as the accessor holds them.
  std::vector<Eigen::Vector3d> control_points;
  for (const Eigen::Vector3f& p : asset.control_points) control_points.push_back(p.cast<double>());
  return encode::encode(base, small_details(base, control_points, detail_scale),
                        options(false, detail_scale))
      .bytes;
}

// A box around the surfaces of the prefixes in the table and a twentieth of its diagonal more.
Eigen::AlignedBox3f box_of_surfaces(const gltf::ProgressiveAsset& asset) {
  std::vector<float> positions;
  for (const Eigen::Vector3f& p : asset.control_points)
    positions.insert(positions.end(), p.data(), p.data() + 3);
  surface::ProgressiveSurface surface({asset.base, positions, asset.levels});
  std::vector<Eigen::Vector3f> limits(surface.counts(asset.levels).vertices);
  Eigen::AlignedBox3f box;
  std::size_t fed = 0;
  for (const gltf::PrefixEntry& entry : asset.prefixes) {
    surface.feed(std::span(asset.payload).subspan(fed, entry.byte_length - fed));
    fed = entry.byte_length;
    surface.write_limits(asset.levels, {{limits.data(), sizeof(Eigen::Vector3f)}, {}});
    for (const Eigen::Vector3f& p : limits) box.extend(p);
  }
  const Eigen::Vector3f margin = Eigen::Vector3f::Constant(box.diagonal().norm() / 20);
  return {box.min() - margin, box.max() + margin};
}

// `asset` with the payload, and all that depends on it, that its own base and `shape`'s tags give.
// `unit` is the length of its coordinates' unit; only details in that size stay in the bounds.
gltf::ProgressiveAsset with_payload(gltf::ProgressiveAsset asset, const Shape& shape, double unit,
                                    double detail_scale) {
  const auto set_payload = [&](double scale) {
    asset.payload = payload_of(asset, shape, scale);
    asset.payload_length = asset.payload.size();
    asset.prefixes.clear();
    for (std::uint64_t part = 0; part <= 4; ++part)
      asset.prefixes.push_back(
          {asset.payload_length * part / 4, 0.5 / static_cast<double>(part + 1)});
  };
  asset.levels = kLevels;
  asset.source_diagonal = double{(asset.bounds_max - asset.bounds_min).norm()};
  set_payload(unit);
  const Eigen::AlignedBox3f box = box_of_surfaces(asset);
  asset.bounds_min = box.min();
  asset.bounds_max = box.max();
  if (detail_scale != 1) set_payload(unit * detail_scale);
  return asset;
}

}  // namespace

gltf::ProgressiveAsset encoded_asset(const Shape& shape, double detail_scale) {
  return with_payload(sample_asset(shape, 1), shape, 1, detail_scale);
}

gltf::ProgressiveAsset encoded_grid_asset(const Shape& shape) {
  gltf::ProgressiveAsset asset = grid_asset(shape, 1);
  const double unit = 1 / asset.placement.scale;
  return with_payload(std::move(asset), shape, unit, 1);
}

std::vector<std::uint8_t> encoded_stream(const Shape& shape) {
  const bitstream::BaseTopology unordered = topology_of(shape);
  const bitstream::BaseOrder order = bitstream::canonical_base_order(unordered);
  const bitstream::BaseTopology base = bitstream::reorder(unordered, order);
  std::vector<Eigen::Vector3d> control_points;
  for (std::uint32_t old : order.vertices) control_points.push_back(shape.mesh.positions[old]);
  return encode::encode(base, small_details(base, control_points, 1), options(true, 1)).bytes;
}

}  // namespace zerotree::test
