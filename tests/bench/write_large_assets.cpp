// Writes valid files of about 100 MB, to see what validating (or reading) them costs.
// Usage: write_large_assets FOLDER
//   large-base.glb      1.5 million base vertices, one level
//   dense-details.glb   4,000 base vertices, six levels, 90 MB of details
//   other-data.glb      that base with two levels beside 100 MB of something else
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "bitstream/base_edges.h"
#include "bitstream/base_hash.h"
#include "encode/header_writer.h"
#include "encode/stream_encoder.h"
#include "export/atomic_file.h"
#include "gltf/glb_container.h"
#include "gltf/progressive_writer.h"

namespace {

using namespace zerotree;

// A closed base of `rings` x `sides` vertices.
gltf::ProgressiveAsset torus(std::uint32_t rings, std::uint32_t sides) {
  gltf::ProgressiveAsset asset;
  asset.base.vertex_count = rings * sides;
  for (std::uint32_t i = 0; i < rings; ++i)
    for (std::uint32_t k = 0; k < sides; ++k) {
      const double u = 2 * std::numbers::pi * i / rings, v = 2 * std::numbers::pi * k / sides;
      const double r = 3 + std::cos(v);
      asset.control_points.emplace_back(static_cast<float>(r * std::cos(u)),
                                        static_cast<float>(r * std::sin(u)),
                                        static_cast<float>(std::sin(v)));
      const std::uint32_t next_i = (i + 1) % rings, next_k = (k + 1) % sides;
      const std::uint32_t a = i * sides + k, b = next_i * sides + k, c = next_i * sides + next_k,
                          d = i * sides + next_k;
      asset.base.triangles.push_back({a, b, c});
      asset.base.triangles.push_back({a, c, d});
    }
  asset.bounds_min = {-4.1f, -4.1f, -1.1f};
  asset.bounds_max = {4.1f, 4.1f, 1.1f};
  asset.source_diagonal = 11.5;
  return asset;
}

// Details of Laplacian size: `mean` steps on the finest level, twice as many on each coarser one.
bitstream::CoefficientSet random_details(std::size_t edges, int levels, double mean) {
  bitstream::CoefficientSet details{edges, levels, {}};
  std::mt19937 random(1);
  for (std::vector<std::int32_t>& channel : details.channels) {
    channel.reserve(edges * bitstream::cells_below(levels));
    for (int level = 0; level < levels; ++level)
      for (std::size_t i = 0; i < edges << (2 * level); ++i) {
        const double share = (static_cast<double>(random()) + 1.0) * 0x1p-32;
        const auto size =
            static_cast<std::int32_t>(-std::ldexp(mean, levels - 1 - level) * std::log(share));
        const std::int32_t value = size == 0 ? 0 : 2 * size + 1;
        channel.push_back((random() & 1) != 0 ? -value : value);
      }
  }
  return details;
}

void add_payload(gltf::ProgressiveAsset& asset, int levels, double mean) {
  std::vector<float> positions;
  for (const Eigen::Vector3f& p : asset.control_points)
    positions.insert(positions.end(), p.data(), p.data() + 3);
  encode::StreamContent content;
  content.header.external_base = true;
  content.header.levels = levels;
  content.header.transform = 1;
  content.header.finest_step = encode::storable_step(1e-4 / std::max(mean, 1.0));
  content.header.base_hash = bitstream::hash_base(asset.base, positions);
  content.base = asset.base;
  const std::size_t edges = bitstream::number_base_edges(asset.base).edges.size();
  content.coefficients = random_details(edges, levels, mean);
  asset.payload = encode::encode_stream(content).bytes;
  asset.payload_length = asset.payload.size();
  asset.levels = levels;
  for (int part = 6; part >= 0; --part)
    asset.prefixes.push_back({asset.payload_length >> part, std::ldexp(0.01, part)});
}

void write(const std::filesystem::path& path, const std::vector<std::uint8_t>& bytes) {
  exporter::write_file_atomically(path, bytes);
  std::printf("%s: %zu bytes\n", path.string().c_str(), bytes.size());
}

// `glb` with `size` bytes that nothing refers to in front of its binary data.
std::vector<std::uint8_t> with_other_data(const std::vector<std::uint8_t>& glb, std::size_t size) {
  const gltf::GlbChunks chunks = gltf::split_glb(glb);
  nlohmann::json root = nlohmann::json::parse(chunks.json);
  for (nlohmann::json& view : root["bufferViews"])
    view["byteOffset"] = view.value("byteOffset", std::size_t{0}) + size;
  root["buffers"][0]["byteLength"] = root["buffers"][0]["byteLength"].get<std::size_t>() + size;
  std::vector<std::uint8_t> bytes = gltf::glb_head(root.dump(), chunks.binary.size() + size);
  bytes.resize(bytes.size() + size);
  bytes.insert(bytes.end(), chunks.binary.begin(), chunks.binary.end());
  return bytes;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: %s FOLDER\n", argv[0]);
    return 2;
  }
  const std::filesystem::path folder = argv[1];
  std::filesystem::create_directories(folder);
  gltf::ProgressiveAsset large = torus(1500, 1000);
  add_payload(large, 1, 1e6);
  write(folder / "large-base.glb", gltf::glb_bytes(large));
  gltf::ProgressiveAsset dense = torus(100, 40);
  add_payload(dense, 6, 8000);
  write(folder / "dense-details.glb", gltf::glb_bytes(dense));
  gltf::ProgressiveAsset small = torus(100, 40);
  add_payload(small, 2, 0.5);
  write(folder / "other-data.glb", with_other_data(gltf::glb_bytes(small), 100'000'000));
  return 0;
}
