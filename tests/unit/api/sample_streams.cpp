#include "sample_streams.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include "analysis/wavelet_decomposition.h"
#include "bitstream/base_traversal.h"
#include "surface/subdivision_hierarchy.h"

namespace zerotree::test {

Sample sample_stream(const Shape& shape, const SampleOptions& options) {
  const bitstream::BaseTopology plain{static_cast<std::uint32_t>(shape.mesh.positions.size()),
                                      shape.mesh.triangles, shape.crease_edges,
                                      shape.corner_vertices};
  const bitstream::BaseOrder order = bitstream::canonical_base_order(plain);
  Sample sample;
  sample.levels = options.levels;
  sample.base = bitstream::reorder(plain, order);
  analysis::WaveletDecomposition decomposition;
  for (const std::uint32_t old : order.vertices)
    decomposition.base_control_points.push_back(shape.mesh.positions[old]);
  const surface::SubdivisionHierarchy hierarchy(sample.base, options.levels, {});
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (int level = 0; level < options.levels; ++level)
    for (auto& details = decomposition.details.emplace_back();
         details.size() < hierarchy.level(level).edge_count;)
      details.push_back(0.02 * std::pow(0.4, level) *
                        Eigen::Vector3d(uniform(random), uniform(random), uniform(random)));
  encode::EncodeOptions encoding;
  encoding.finest_step = options.finest_step;
  encoding.embed_base = options.embed_base;
  sample.stream = encode::encode(sample.base, decomposition, encoding);
  return sample;
}

std::vector<std::uint32_t> flat_indices(const bitstream::BaseTopology& base) {
  std::vector<std::uint32_t> indices;
  for (const auto& triangle : base.triangles)
    indices.insert(indices.end(), triangle.begin(), triangle.end());
  return indices;
}

Decoder decoder_for(const Sample& sample, bool embedded) {
  if (embedded) return Decoder();
  return Decoder(sample.stream.base_positions, flat_indices(sample.base), sample.levels);
}

namespace {

using DirectedEdge = std::pair<std::uint32_t, std::uint32_t>;

std::vector<DirectedEdge> directed_edges(const std::vector<std::uint32_t>& indices) {
  std::vector<DirectedEdge> edges;
  for (std::size_t k = 0; k < indices.size(); ++k)
    edges.emplace_back(indices[k], indices[k % 3 == 2 ? k - 2 : k + 1]);
  std::sort(edges.begin(), edges.end());
  return edges;
}

}  // namespace

std::size_t expect_complete(const SurfaceSamples& surface) {
  EXPECT_FALSE(surface.indices.empty());
  std::vector<bool> is_used(surface.positions.size() / 3);
  for (const std::uint32_t index : surface.indices) {
    if (index >= is_used.size()) {
      ADD_FAILURE() << "index " << index << " of " << is_used.size() << " vertices";
      return 0;
    }
    is_used[index] = true;
  }
  EXPECT_EQ(std::count(is_used.begin(), is_used.end(), false), 0);
  const std::vector<DirectedEdge> edges = directed_edges(surface.indices);
  EXPECT_EQ(std::adjacent_find(edges.begin(), edges.end()), edges.end());
  const auto is_finite = [](float x) { return std::isfinite(x); };
  EXPECT_TRUE(std::all_of(surface.positions.begin(), surface.positions.end(), is_finite));
  float worst = 0;
  for (std::size_t k = 0; k < surface.normals.size(); k += 3) {
    const float length =
        std::hypot(surface.normals[k], surface.normals[k + 1], surface.normals[k + 2]);
    // Not std::max, which would lose a NaN.
    if (!(std::abs(length - 1.0f) <= worst)) worst = std::abs(length - 1.0f);
  }
  EXPECT_LT(worst, 1e-5f);
  return static_cast<std::size_t>(
      std::count_if(edges.begin(), edges.end(), [&](const DirectedEdge& edge) {
        return !std::binary_search(edges.begin(), edges.end(),
                                   DirectedEdge(edge.second, edge.first));
      }));
}

}  // namespace zerotree::test
