// How long decoding takes: prefixes of a stream, at once and in pieces.
// Usage: decode_benchmark STREAM.zt [options of Google Benchmark]
// STREAM.zt is an elementary stream, as `zerotree convert in.ply -o out.glb --stream out.zt` writes
// it, or the word "sphere" for one made in code.
#include <benchmark/benchmark.h>
#include <malloc.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "bitstream/base_edges.h"
#include "bitstream/base_traversal.h"
#include "bitstream/stream_decoder.h"
#include "encode/header_writer.h"
#include "encode/stream_encoder.h"
#include "shapes.h"

namespace {

using zerotree::bitstream::DecodeStatus;
using zerotree::bitstream::StreamDecoder;
using Bytes = std::vector<std::uint8_t>;

constexpr int kLevels = 5;

// Details of Laplacian size over a base of 162 vertices: as many cells as a scan of 150,000.
Bytes sphere_stream() {
  namespace bitstream = zerotree::bitstream;
  const zerotree::TriangleMesh mesh = zerotree::test::sphere(2);
  bitstream::BaseTopology base{
      static_cast<std::uint32_t>(mesh.positions.size()), mesh.triangles, {}, {}};
  base = bitstream::reorder(base, bitstream::canonical_base_order(base));
  zerotree::encode::StreamContent content;
  content.header.levels = kLevels;
  content.header.finest_step = zerotree::encode::storable_step(0.001);
  content.header.positions = {
      {}, zerotree::encode::storable_scale(content.header.finest_step, 0.01), 12, 4};
  content.positions.assign(std::size_t{3} * base.vertex_count, 2048);
  const std::size_t edges = bitstream::number_base_edges(base).edges.size();
  content.base = std::move(base);
  content.coefficients = {edges, kLevels, {}};
  std::mt19937 random(1);
  for (std::vector<std::int32_t>& channel : content.coefficients.channels) {
    for (int level = 0; level < kLevels; ++level) {
      const double mean = 0.5 * std::pow(5.0, kLevels - 1 - level);
      for (std::size_t i = 0; i < edges << (2 * level); ++i) {
        const double size = -mean * std::log((static_cast<double>(random()) + 1.0) * 0x1p-32);
        const auto m = static_cast<std::int32_t>(size);
        const std::int32_t value = m == 0 ? 0 : 2 * m + 1;
        channel.push_back((random() & 1) != 0 ? -value : value);
      }
    }
  }
  return encode_stream(content).bytes;
}

Bytes file_bytes(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void decode(benchmark::State& state, std::span<const std::uint8_t> bytes, std::size_t piece) {
  for (auto _ : state) {
    StreamDecoder decoder;
    for (std::size_t begin = 0; begin < bytes.size(); begin += piece) {
      decoder.feed(bytes.subspan(begin, std::min(piece, bytes.size() - begin)));
    }
    if (decoder.status() == DecodeStatus::broken) {
      state.SkipWithError(decoder.reason().c_str());
      return;
    }
    benchmark::DoNotOptimize(decoder.detailed_levels());
  }
  state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations() * bytes.size()));
}

void add_benchmarks(const Bytes& stream) {
  for (const std::size_t wanted : {std::size_t{8500}, std::size_t{48000}, stream.size()}) {
    const std::size_t length = std::min(wanted, stream.size());
    const std::span<const std::uint8_t> prefix(stream.data(), length);
    for (const std::size_t piece : {length, std::size_t{1024}, std::size_t{16}}) {
      const std::string name =
          "decode/bytes:" + std::to_string(length) + "/piece:" + std::to_string(piece);
      benchmark::RegisterBenchmark(name.c_str(), [=](benchmark::State& state) {
        decode(state, prefix, piece);
      })->Unit(benchmark::kMillisecond);
    }
    if (length == stream.size()) return;
  }
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (argc != 2) {
    std::fprintf(stderr, "usage: %s STREAM.zt|sphere [options of Google Benchmark]\n", argv[0]);
    return 2;
  }
  // Memory given back to the system costs page faults with every decoder, which are not decoding.
  mallopt(M_MMAP_THRESHOLD, 1 << 30);
  mallopt(M_TRIM_THRESHOLD, 1 << 30);
  const std::string path = argv[1];
  const Bytes stream = path == "sphere" ? sphere_stream() : file_bytes(path);
  if (stream.empty()) {
    std::fprintf(stderr, "%s: no such file, or nothing in it\n", argv[1]);
    return 1;
  }
  add_benchmarks(stream);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
