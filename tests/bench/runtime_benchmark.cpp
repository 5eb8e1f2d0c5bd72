// How fast the runtime is beside libdraco and libmeshoptimizer, in one process and one run.
// Usage: runtime_benchmark STREAM.zt --facts
//        runtime_benchmark STREAM.zt [--pair=BYTES:LEVEL]... [--deep=STREAM.zt]
//        [--draco=FILE.drc]...
//                          [options of Google Benchmark]
// A pair is a prefix and the level it is shown at; --deep is a stream of more levels for the speed
// of synthesis. meshoptimizer decodes the meshes of Draco's files. Streams are written by `zerotree
// convert in.ply -o out.glb --stream out.zt`; runtime.sh makes all of this and a table.
//
// Times are processor time of the calling thread and shown as "Time"; those called "wall" are not.
// Memory is warm on all sides: what was freed is used again without the system.
#include <benchmark/benchmark.h>
#include <draco/compression/decode.h>
#include <malloc.h>
#include <meshoptimizer.h>

#include <cmath>
#include <cstring>
#include <utility>

#include "counted_memory.h"
#include "runtime_facts.h"
#include "stream_session.h"
#include "worker_pool.h"

namespace {

using namespace zerotree::bench;
using benchmark::State;

constexpr std::size_t kStep = 1024;              // bytes that arrive together
constexpr std::size_t kSteppedPrefix = 100'000;  // and the prefix that arrives so
constexpr int kVertexBits = 14;                  // of meshoptimizer's positions

RecyclingAllocator& allocator() {
  static RecyclingAllocator recycling;
  return recycling;
}

Decoder fed_decoder(const Bytes& stream, std::size_t size, const zt_jobs& jobs = {}) {
  Decoder decoder = make_decoder(allocator().callbacks(), jobs);
  feed(decoder, stream, 0, size);
  return decoder;
}

/// Time of `work` on what `prepare` returns; not that of `prepare`.
template <class Prepare, class Work>
void measure(State& state, double (*clock)(), const Prepare& prepare, const Work& work) {
  for (auto _ : state) {
    auto prepared = prepare();
    const double start = clock();
    work(prepared);
    state.SetIterationTime(clock() - start);
  }
}

struct Nothing {};

/// Few iterations where each needs a decoder made ready; otherwise as many as fill the time.
constexpr int kPrepared = 3, kAtOnce = 0;

template <class Measure>
void add(const std::string& name, int iterations, const Measure& run) {
  auto* added = benchmark::RegisterBenchmark(name.c_str(), run);
  if (iterations > 0) added->Iterations(iterations);
  added->UseManualTime()
      ->Unit(benchmark::kMicrosecond)
      ->ComputeStatistics("min", [](const std::vector<double>& values) {
        return *std::min_element(values.begin(), values.end());
      });
}

void add_pair(const Bytes& stream, std::size_t size, int level) {
  const std::string at = "/" + std::to_string(size) + ":" + std::to_string(level);
  auto buffers = std::make_shared<SurfaceBuffers>(fed_decoder(stream, size), level);
  add("ours" + at, kAtOnce, [=, &stream](State& state) {
    measure(
        state, cpu_seconds, [] { return Nothing{}; },
        [&](Nothing) {
          const Decoder decoder = fed_decoder(stream, size);
          buffers->reconstruct(decoder);
          buffers->get_indices(decoder);
        });
  });
  add("feed" + at, kAtOnce, [=, &stream](State& state) {
    measure(
        state, cpu_seconds, [] { return Nothing{}; },
        [&](Nothing) { benchmark::DoNotOptimize(fed_decoder(stream, size)); });
  });
  add("first_surface" + at, kPrepared, [=, &stream](State& state) {
    measure(
        state, cpu_seconds, [&] { return fed_decoder(stream, size); },
        [&](const Decoder& decoder) { buffers->reconstruct(decoder); });
  });
  const auto surface = [=, &stream](std::size_t bytes) {
    Decoder decoder = fed_decoder(stream, bytes);
    buffers->reconstruct(decoder);
    return decoder;
  };
  add("indices" + at, kPrepared, [=](State& state) {
    measure(
        state, cpu_seconds, [&] { return surface(size); },
        [&](const Decoder& decoder) { buffers->get_indices(decoder); });
  });
  const std::size_t before = size - std::min(size / 2, kStep);
  add("step_feed" + at, kPrepared, [=, &stream](State& state) {
    measure(
        state, cpu_seconds, [&] { return surface(before); },
        [&](const Decoder& decoder) { feed(decoder, stream, before, size); });
  });
  add("step_surface" + at, kPrepared, [=, &stream](State& state) {
    measure(
        state, cpu_seconds,
        [&] {
          Decoder decoder = surface(before);
          feed(decoder, stream, before, size);
          return decoder;
        },
        [&](const Decoder& decoder) { buffers->reconstruct(decoder); });
  });
}

void add_feeding(const Bytes& stream) {
  const std::size_t size = std::min(kSteppedPrefix, stream.size());
  for (const std::size_t piece : {size, kStep})
    add(piece == size ? "feed_at_once" : "feed_in_steps", kAtOnce, [=, &stream](State& state) {
      measure(
          state, cpu_seconds, [] { return Nothing{}; },
          [&](Nothing) {
            const Decoder decoder = make_decoder(allocator().callbacks());
            feed_in_pieces(decoder, stream, size, piece);
          });
      state.counters["bytes"] = static_cast<double>(size);
    });
}

/// All levels anew in memory that the decoder already has, as after bytes for all of them.
void add_synthesis(const Bytes& stream) {
  const Decoder whole = fed_decoder(stream, stream.size());
  const int level = info_of(whole).levels;
  auto buffers = std::make_shared<SurfaceBuffers>(whole, level);
  const auto add_one = [&](const std::string& name, std::uint32_t threads, double (*clock)(),
                           bool with_normals) {
    add("synthesis_" + name, kPrepared, [=, &stream](State& state) {
      WorkerPool pool(threads);
      const zt_jobs jobs = threads > 1 ? pool.jobs() : zt_jobs{};
      measure(
          state, clock,
          [&] {
            Decoder decoder = fed_decoder(stream, stream.size() / 2, jobs);
            buffers->reconstruct(decoder, with_normals);
            feed(decoder, stream, stream.size() / 2, stream.size());
            return decoder;
          },
          [&](const Decoder& decoder) { buffers->reconstruct(decoder, with_normals); });
      state.counters["vertices"] = buffers->vertices;
      state.counters["level"] = level;
    });
  };
  add_one("positions", 1, cpu_seconds, false);
  add_one("with_normals", 1, cpu_seconds, true);
  add_one("wall_one_thread", 1, wall_seconds, true);
  add_one("wall_two_threads", 2, wall_seconds, true);
}

std::unique_ptr<draco::Mesh> decode_draco(const Bytes& file) {
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(file.data()), file.size());
  draco::Decoder decoder;
  auto mesh = decoder.DecodeMeshFromBuffer(&buffer);
  require(mesh.ok(), "Draco refuses its file");
  return std::move(mesh).value();
}

/// A mesh as meshoptimizer's codecs hold it.
struct MeshoptMesh {
  using Vertex = std::array<std::uint16_t, 4>;  // their vertices are multiples of four bytes
  std::size_t vertices, indices;
  Bytes coded_vertices, coded_indices;

  explicit MeshoptMesh(const draco::Mesh& mesh);
};

MeshoptMesh::MeshoptMesh(const draco::Mesh& mesh)
    : vertices(mesh.num_points()), indices(std::size_t{3} * mesh.num_faces()) {
  const draco::PointAttribute& attribute =
      *mesh.GetNamedAttribute(draco::GeometryAttribute::POSITION);
  std::vector<std::array<float, 3>> positions(vertices);
  for (std::size_t i = 0; i < vertices; ++i)
    attribute.GetMappedValue(draco::PointIndex(static_cast<std::uint32_t>(i)), positions[i].data());
  std::array<float, 3> low = positions[0];
  float extent = 0;
  for (const auto& p : positions)
    for (std::size_t axis = 0; axis < 3; ++axis) low[axis] = std::min(low[axis], p[axis]);
  for (const auto& p : positions)
    for (std::size_t axis = 0; axis < 3; ++axis) extent = std::max(extent, p[axis] - low[axis]);
  std::vector<Vertex> quantised(vertices);
  for (std::size_t i = 0; i < vertices; ++i)
    for (std::size_t axis = 0; axis < 3; ++axis)
      quantised[i][axis] = static_cast<std::uint16_t>(
          meshopt_quantizeUnorm((positions[i][axis] - low[axis]) / extent, kVertexBits));

  std::vector<unsigned int> order;
  for (draco::FaceIndex face(0); face < mesh.num_faces(); ++face)
    for (const draco::PointIndex point : mesh.face(face)) order.push_back(point.value());
  meshopt_optimizeVertexCacheStrip(order.data(), order.data(), indices, vertices);
  vertices = meshopt_optimizeVertexFetch(quantised.data(), order.data(), indices, quantised.data(),
                                         vertices, sizeof(Vertex));
  coded_vertices.resize(meshopt_encodeVertexBufferBound(vertices, sizeof(Vertex)));
  coded_vertices.resize(meshopt_encodeVertexBuffer(coded_vertices.data(), coded_vertices.size(),
                                                   quantised.data(), vertices, sizeof(Vertex)));
  coded_indices.resize(meshopt_encodeIndexBufferBound(indices, vertices));
  coded_indices.resize(
      meshopt_encodeIndexBuffer(coded_indices.data(), coded_indices.size(), order.data(), indices));
}

void add_peers(const std::string& path) {
  const std::string name = path.substr(path.rfind('/') + 1);
  const auto file = std::make_shared<const Bytes>(file_bytes(path));
  const std::unique_ptr<draco::Mesh> mesh = decode_draco(*file);
  const double vertices = mesh->num_points(), triangles = mesh->num_faces();
  add("draco/" + name, kAtOnce, [=](State& state) {
    measure(
        state, cpu_seconds, [] { return Nothing{}; },
        [&](Nothing) { benchmark::DoNotOptimize(decode_draco(*file)); });
    state.counters["vertices"] = vertices;
    state.counters["triangles"] = triangles;
    state.counters["bytes"] = static_cast<double>(file->size());
  });
  const auto coded = std::make_shared<const MeshoptMesh>(*mesh);
  add("meshoptimizer/" + name, kAtOnce, [=](State& state) {
    std::vector<MeshoptMesh::Vertex> to(coded->vertices);
    std::vector<std::uint32_t> indices(coded->indices);
    measure(
        state, cpu_seconds, [] { return Nothing{}; },
        [&](Nothing) {
          const int of_vertices = meshopt_decodeVertexBuffer(
              to.data(), coded->vertices, sizeof(MeshoptMesh::Vertex), coded->coded_vertices.data(),
              coded->coded_vertices.size());
          const int of_indices =
              meshopt_decodeIndexBuffer(indices.data(), coded->indices, sizeof(std::uint32_t),
                                        coded->coded_indices.data(), coded->coded_indices.size());
          require(of_vertices == 0 && of_indices == 0, "meshoptimizer refuses its own bytes");
        });
    state.counters["vertices"] = static_cast<double>(coded->vertices);
    state.counters["triangles"] = static_cast<double>(coded->indices) / 3;
    state.counters["bytes"] =
        static_cast<double>(coded->coded_vertices.size() + coded->coded_indices.size());
  });
}

/// The rest of `argument` if it begins with `option`, otherwise null.
const char* value_of(const char* argument, const char* option) {
  const std::size_t length = std::strlen(option);
  return std::strncmp(argument, option, length) == 0 ? argument + length : nullptr;
}

int usage(const char* program) {
  std::fprintf(
      stderr,
      "usage: %s STREAM.zt --facts\n"
      "       %s STREAM.zt [--pair=BYTES:LEVEL]... [--deep=STREAM.zt] [--draco=FILE.drc]..."
      " [options of Google Benchmark]\n",
      program, program);
  return 2;
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (argc < 2) return usage(argv[0]);
  // Memory given back to the system costs page faults with every decoder, which are not decoding.
  mallopt(M_MMAP_THRESHOLD, 1 << 30);
  mallopt(M_TRIM_THRESHOLD, 1 << 30);
  const Bytes stream = file_bytes(argv[1]);
  Bytes deep;
  if (argc == 3 && std::strcmp(argv[2], "--facts") == 0) {
    print_runtime_facts(stream);
    return 0;
  }
  for (int i = 2; i < argc; ++i) {
    std::size_t size = 0;
    int level = 0;
    if (const char* path = value_of(argv[i], "--draco=")) {
      add_peers(path);
    } else if (const char* deep_path = value_of(argv[i], "--deep=")) {
      deep = file_bytes(deep_path);
    } else if (std::sscanf(argv[i], "--pair=%zu:%d", &size, &level) == 2) {
      add_pair(stream, std::min(size, stream.size()), level);
    } else {
      return usage(argv[0]);
    }
  }
  add_feeding(stream);
  add_synthesis(deep.empty() ? stream : deep);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
