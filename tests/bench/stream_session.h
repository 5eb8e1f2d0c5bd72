// A decoder, its stream and the caller's buffers, for the benchmarks of the runtime.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include "zerotree/zerotree.h"

namespace zerotree::bench {

using Bytes = std::vector<std::uint8_t>;

inline Bytes file_bytes(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  Bytes bytes{std::istreambuf_iterator<char>(file), {}};
  if (bytes.empty()) {
    std::fprintf(stderr, "%s: no such file, or nothing in it\n", path.c_str());
    std::exit(1);
  }
  return bytes;
}

/// Ends the program where a benchmark would measure a failure.
inline void require(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "the benchmark stopped: %s\n", what);
  std::exit(1);
}

/// Seconds. Of this thread alone: what others do on the machine counts little.
inline double cpu_seconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

inline double wall_seconds() {
  timespec time{};
  clock_gettime(CLOCK_MONOTONIC, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

struct FreeDecoder {
  void operator()(zt_decoder* decoder) const { zt_free(decoder); }
};
using Decoder = std::unique_ptr<zt_decoder, FreeDecoder>;

inline Decoder make_decoder(const zt_allocator& allocator, const zt_jobs& jobs = {}) {
  zt_options options{};
  options.sampling = ZT_SAMPLE_BALANCED;  // as runtime.py measures the errors
  options.struct_size = sizeof options;
  options.allocator = allocator;
  options.jobs = jobs;
  Decoder decoder(zt_create(&options));
  require(decoder != nullptr, "out of memory");
  return decoder;
}

inline zt_info info_of(const Decoder& decoder) {
  zt_info info;
  zt_get_info(decoder.get(), &info, sizeof info);
  return info;
}

/// What a caller has room for at one level.
struct SurfaceBuffers {
  SurfaceBuffers(const Decoder& decoder, int at_level)
      : level(at_level),
        vertices(zt_vertex_count(decoder.get(), level)),
        triangles(zt_triangle_count(decoder.get(), level)),
        positions(std::size_t{3} * vertices),
        normals(std::size_t{3} * vertices),
        indices(std::size_t{3} * triangles) {
    require(vertices > 0, "the stream has no such level, or its prefix no base mesh");
  }

  void reconstruct(const Decoder& decoder, bool with_normals = true) {
    require(zt_reconstruct(decoder.get(), level, positions.data(), 0,
                           with_normals ? normals.data() : nullptr, 0, vertices) == ZT_OK,
            "a surface was refused");
  }
  void get_indices(const Decoder& decoder) {
    require(zt_get_indices(decoder.get(), level, indices.data(), 4, triangles) == ZT_OK,
            "indices were refused");
  }

  int level;
  std::uint32_t vertices, triangles;
  std::vector<float> positions, normals;
  std::vector<std::uint32_t> indices;
};

inline void feed(const Decoder& decoder, const Bytes& bytes, std::size_t begin, std::size_t end) {
  require(zt_feed(decoder.get(), bytes.data() + begin, end - begin) != ZT_BROKEN,
          "the stream is broken");
}

inline void feed_in_pieces(const Decoder& decoder, const Bytes& bytes, std::size_t end,
                           std::size_t piece) {
  for (std::size_t begin = 0; begin < end; begin += piece)
    feed(decoder, bytes, begin, std::min(begin + piece, end));
}

}  // namespace zerotree::bench
