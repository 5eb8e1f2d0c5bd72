// Inputs for the fuzzer to begin with: right streams of all sorts, decoded in some ways each.
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <random>
#include <string>
#include <vector>

#include "analysis/wavelet_decomposition.h"
#include "bitstream/base_topology.h"
#include "bitstream/base_traversal.h"
#include "encode/encode.h"
#include "fuzz_bases.h"
#include "fuzz_plan.h"
#include "shapes.h"
#include "surface/subdivision_hierarchy.h"

namespace {

using namespace zerotree;

constexpr int kLevels = 2;

std::vector<std::uint8_t> stream_of(const bitstream::BaseTopology& base,
                                    const std::vector<Eigen::Vector3d>& positions,
                                    encode::EncodeOptions options) {
  const surface::SubdivisionHierarchy hierarchy(base, kLevels, options.transform);
  analysis::WaveletDecomposition decomposition;
  decomposition.base_control_points = positions;
  std::mt19937 random(3);
  // std::uniform_real_distribution differs between libraries; seeds are the same everywhere.
  const auto next = [&] { return static_cast<double>(random()) * 0x1p-31 - 1.0; };
  for (int level = 0; level < kLevels; ++level)
    for (auto& details = decomposition.details.emplace_back();
         details.size() < hierarchy.level(level).edge_count;) {
      const double x = next(), y = next(), z = next();
      details.push_back(0.05 * std::pow(0.3, level) * Eigen::Vector3d(x, y, z));
    }
  options.finest_step = 2e-3;
  return encode::encode(hierarchy, decomposition, options).bytes;
}

/// Some schedules over one stream.
class SeedWriter {
 public:
  explicit SeedWriter(std::filesystem::path folder) : folder_(std::move(folder)) {
    std::filesystem::create_directories(folder_);
  }

  void write(const std::string& name, std::uint8_t base, const std::vector<std::uint8_t>& stream) {
    for (int way = 0; way < 3; ++way) {
      fuzz::FuzzPlan plan;
      plan.base = base;
      plan.levels = kLevels;
      plan.failing = way == 2 ? static_cast<std::uint8_t>(5 + random_() % 60) : 0;
      plan.workers = way == 1 ? 3 : 0;
      plan.seed = static_cast<std::uint8_t>(random_());
      for (std::uint8_t& step : plan.steps) step = static_cast<std::uint8_t>(random_());
      // All of it at once to begin with, or in pieces of the schedule.
      if (way == 0) plan.steps.front() = 0xf0;
      std::ofstream out(folder_ / (name + "-" + std::to_string(way)), std::ios::binary);
      const auto put = [&](const auto& bytes) {
        out.write(reinterpret_cast<const char*>(bytes.data()),
                  static_cast<std::streamsize>(bytes.size()));
      };
      put(plan.bytes());
      put(stream);
      if (!out.flush()) throw std::runtime_error("cannot write " + folder_.string());
    }
  }

 private:
  std::filesystem::path folder_;
  std::mt19937 random_{1};
};

void write_embedded(SeedWriter& seeds, surface::WaveletTransform transform,
                    const std::string& suffix) {
  for (const test::Shape& shape : test::base_shapes()) {
    const bitstream::BaseTopology plain{static_cast<std::uint32_t>(shape.mesh.positions.size()),
                                        shape.mesh.triangles, shape.crease_edges,
                                        shape.corner_vertices};
    const bitstream::BaseOrder order = bitstream::canonical_base_order(plain);
    std::vector<Eigen::Vector3d> positions;
    for (const std::uint32_t old : order.vertices) positions.push_back(shape.mesh.positions[old]);
    encode::EncodeOptions options;
    options.transform = transform;
    options.embed_base = true;
    seeds.write(shape.name + suffix, 0, stream_of(reorder(plain, order), positions, options));
  }
}

void write_bound(SeedWriter& seeds, surface::WaveletTransform transform,
                 const std::string& suffix) {
  for (int number = 0; number < fuzz::kFuzzBases; ++number) {
    const fuzz::FuzzBase known = fuzz::fuzz_base(number);
    bitstream::BaseTopology base;
    std::vector<Eigen::Vector3d> positions;
    for (std::size_t i = 0; i < known.positions.size(); i += 3)
      positions.emplace_back(known.positions[i], known.positions[i + 1], known.positions[i + 2]);
    for (std::size_t i = 0; i < known.indices.size(); i += 3)
      base.triangles.push_back({known.indices[i], known.indices[i + 1], known.indices[i + 2]});
    base.vertex_count = static_cast<std::uint32_t>(positions.size());
    base.crease_edges = known.crease_edges;
    encode::EncodeOptions options;
    options.transform = transform;
    options.embed_base = false;
    seeds.write("bound" + std::to_string(number) + suffix, static_cast<std::uint8_t>(1 + number),
                stream_of(base, positions, options));
  }
}

/// Bases out of bytes: one that is a surface, and one that is none.
void write_hostile(SeedWriter& seeds) {
  using fuzz::BaseChoice;
  std::vector<std::uint8_t> ones(36);
  for (std::size_t i = 0; i < ones.size(); i += 2) ones[i] = i % 4 == 0 ? 0x3f : 0xbf;
  seeds.write("positions", static_cast<std::uint8_t>(BaseChoice::hostile_positions), ones);
  std::vector<std::uint8_t> pair = {4, 2, 0, 1, 2, 0, 2, 3};
  for (int i = 0; i < 12; ++i) pair.insert(pair.end(), {0x40, static_cast<std::uint8_t>(17 * i)});
  seeds.write("pair", static_cast<std::uint8_t>(BaseChoice::hostile), pair);
  std::vector<std::uint8_t> bow_tie = {5, 2, 0, 1, 2, 0, 3, 4};
  seeds.write("bow_tie", static_cast<std::uint8_t>(BaseChoice::hostile), bow_tie);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: write_fuzz_seeds FOLDER\n";
    return 2;
  }
  SeedWriter seeds(argv[1]);
  using surface::WaveletTransform;
  write_embedded(seeds, WaveletTransform::loop_local, "");
  write_embedded(seeds, WaveletTransform::loop_quadrature_mirror, "-mirror");
  write_bound(seeds, WaveletTransform::loop_local, "");
  write_bound(seeds, WaveletTransform::loop_quadrature_mirror, "-mirror");
  write_hostile(seeds);
}
