#include "random_content.h"

#include <cmath>
#include <random>
#include <stdexcept>

#include "bitstream/base_edges.h"
#include "bitstream/base_hash.h"
#include "bitstream/base_traversal.h"
#include "bitstream/edge_image.h"
#include "encode/header_writer.h"

namespace zerotree::test {
namespace {

constexpr int kPositionBits = 11;

// Uniform in 0..1, without 1; the standard's distributions differ between libraries.
double uniform(std::mt19937& random) {
  return static_cast<double>(random()) * 0x1p-32;
}

// Calls make(channel, level) for every existing cell and stores the magnitude with a random sign.
template <class Make>
void fill(encode::StreamContent& content, std::mt19937& random, Make make) {
  const bitstream::BaseEdges base = bitstream::number_base_edges(content.base);
  for (int level = 0; level < content.coefficients.levels; ++level) {
    const std::size_t begin = bitstream::level_offset(base.edges.size(), level);
    for (std::size_t i = 0; i < base.edges.size() << (2 * level); ++i) {
      const bitstream::EdgeCell cell = bitstream::cell_at(level, i);
      const bool boundary = base.edges[cell.base_edge].faces[1] == bitstream::kNone;
      if (boundary && cell.p < cell.q) continue;
      for (int c = 0; c < bitstream::kChannelCount; ++c) {
        const auto m = static_cast<std::int32_t>(make(c, level));
        const std::int32_t value = m == 0 ? 0 : 2 * m + 1;
        content.coefficients.channels[c][begin + i] = (random() & 1) != 0 ? -value : value;
      }
    }
  }
}

}  // namespace

bitstream::BaseTopology canonical_base(const Shape& shape) {
  const bitstream::BaseTopology base{static_cast<std::uint32_t>(shape.mesh.positions.size()),
                                     shape.mesh.triangles, shape.crease_edges,
                                     shape.corner_vertices};
  return bitstream::reorder(base, bitstream::canonical_base_order(base));
}

std::vector<float> external_positions(const bitstream::BaseTopology& base) {
  std::vector<float> positions(std::size_t{base.vertex_count} * 3);
  for (std::size_t i = 0; i < positions.size(); ++i) {
    positions[i] = 0.25f * static_cast<float>(i % 17) - 1.0f;
  }
  return positions;
}

encode::StreamContent empty_content(const bitstream::BaseTopology& base, int levels, bool embedded,
                                    std::uint32_t seed) {
  encode::StreamContent content;
  content.base = base;
  content.header.levels = levels;
  content.header.finest_step = encode::storable_step(0.001);
  content.header.external_base = !embedded;
  if (embedded) {
    const float scale = encode::storable_scale(content.header.finest_step, 0.01);
    content.header.positions = {{-1, -2, 3}, scale, kPositionBits, 4};
    std::mt19937 random(seed);
    for (std::size_t i = 0; i < std::size_t{base.vertex_count} * 3; ++i) {
      content.positions.push_back(static_cast<std::uint32_t>(random() >> (32 - kPositionBits)));
    }
  } else {
    content.header.base_hash = bitstream::hash_base(base, external_positions(base));
  }
  const std::size_t edges = bitstream::number_base_edges(base).edges.size();
  content.coefficients = {edges, levels, {}};
  for (auto& channel : content.coefficients.channels) {
    channel.assign(bitstream::level_offset(edges, levels), 0);
  }
  return content;
}

void add_random_details(encode::StreamContent& content, double density, int bits,
                        std::uint32_t seed) {
  std::mt19937 random(seed);
  fill(content, random, [&](int, int) -> std::uint32_t {
    if (uniform(random) >= density) return 0;
    return static_cast<std::uint32_t>(random()) >> (32 - 1 - static_cast<int>(random() % bits));
  });
}

void add_laplacian_details(encode::StreamContent& content, double finest_mean, double growth,
                           std::uint32_t seed) {
  std::mt19937 random(seed);
  const int levels = content.header.levels;
  fill(content, random, [&](int c, int level) {
    const double mean =
        finest_mean * std::pow(growth, levels - 1 - level) * (c == bitstream::kNormal ? 1.0 : 0.5);
    return -mean * std::log(1.0 - uniform(random));
  });
}

bitstream::StreamDecoder decoder_for(const encode::StreamContent& content) {
  if (!content.header.external_base) return bitstream::StreamDecoder();
  bitstream::BaseTopology base = content.base;
  base.crease_edges.clear();
  base.corner_vertices.clear();
  return bitstream::StreamDecoder(base, external_positions(base));
}

}  // namespace zerotree::test
