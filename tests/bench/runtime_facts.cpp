#include "runtime_facts.h"

#include "counted_memory.h"

namespace zerotree::bench {
namespace {

constexpr std::uint32_t kBudget = 1000;  // microseconds a call
constexpr int kPasses = 5;
constexpr std::size_t kPiece = 1024;

std::uint64_t allocations_so_far(const RecyclingAllocator& allocator) {
  return allocator.use().allocations + heap_use().allocations;
}

struct MemoryFacts {
  zt_info info;
  std::vector<std::uint32_t> vertices, triangles;  // of each level
  double peak;                                     // of the decoder, without the caller's buffers
  std::uint64_t later_allocations;  // of feeding and reconstructing after the first surface
};

MemoryFacts measure_memory(const Bytes& stream) {
  RecyclingAllocator allocator;
  MemoryFacts facts{};
  const MemoryUse before = heap_use();
  Decoder decoder = make_decoder(allocator.callbacks());
  std::size_t begin = 0;
  while (info_of(decoder).base_ready == 0 && begin < stream.size()) {
    feed(decoder, stream, begin, begin + 1);
    ++begin;
  }
  const zt_info info = info_of(decoder);
  for (int level = 0; level <= info.levels; ++level) {
    facts.vertices.push_back(zt_vertex_count(decoder.get(), level));
    facts.triangles.push_back(zt_triangle_count(decoder.get(), level));
  }
  const MemoryUse without_buffers = heap_use();
  SurfaceBuffers buffers(decoder, info.levels);
  const std::int64_t held_by_buffers = heap_use().held - without_buffers.held;
  forget_heap_peak();
  buffers.reconstruct(decoder);
  buffers.get_indices(decoder);
  const std::uint64_t allocations = allocations_so_far(allocator);
  for (; begin < stream.size(); begin += kPiece) {
    feed(decoder, stream, begin, std::min(begin + kPiece, stream.size()));
    buffers.reconstruct(decoder);
  }
  facts.later_allocations = allocations_so_far(allocator) - allocations;
  facts.info = info_of(decoder);
  // The two peaks may be at different times, so this is at least the true one.
  facts.peak = static_cast<double>(
      allocator.use().peak + std::max(without_buffers.peak, heap_use().peak - held_by_buffers) -
      before.held);
  return facts;
}

/// The longest a call went beyond its budget, in microseconds.
struct Overrun {
  double cpu = 0, wall = 0;
};

template <class Call>
auto timed(Overrun& most, const Call& call) {
  const double cpu = cpu_seconds(), wall = wall_seconds();
  const auto result = call();
  most.wall = std::max(most.wall, 1e6 * (wall_seconds() - wall) - kBudget);
  most.cpu = std::max(most.cpu, 1e6 * (cpu_seconds() - cpu) - kBudget);
  return result;
}

struct Overruns {
  Overrun feed, first_surface, later_surfaces;
  int calls = 0;
};

/// A viewer that spends a budget on bytes and brings the surface up to date, again and again.
Overruns measure_overruns(const Bytes& stream, SurfaceBuffers& buffers,
                          RecyclingAllocator& allocator) {
  Overruns overruns;
  const Decoder decoder = make_decoder(allocator.callbacks());
  bool has_surface = false;
  for (std::size_t begin = 0; begin < stream.size();) {
    std::size_t taken = 0;
    const zt_status status = timed(overruns.feed, [&] {
      return zt_feed_for(decoder.get(), stream.data() + begin, stream.size() - begin, kBudget,
                         &taken);
    });
    ++overruns.calls;
    require(status != ZT_BROKEN && taken > 0, "the stream is broken");
    begin += taken;
    if (info_of(decoder).base_ready == 0) continue;
    zt_result result = ZT_UNFINISHED;
    while (result == ZT_UNFINISHED) {
      result = timed(has_surface ? overruns.later_surfaces : overruns.first_surface, [&] {
        return zt_reconstruct_for(decoder.get(), buffers.level, buffers.positions.data(), 0,
                                  buffers.normals.data(), 0, buffers.vertices, kBudget);
      });
      ++overruns.calls;
    }
    require(result == ZT_OK, "a surface was refused");
    has_surface = true;
  }
  return overruns;
}

/// Of several passes: the pass that the rest of the machine disturbed least, and the worst call of
/// all by processor time.
struct PassedOverrun {
  Overrun least;
  double worst = 0;

  void take(const Overrun& pass, bool is_first) {
    least.cpu = is_first ? pass.cpu : std::min(least.cpu, pass.cpu);
    least.wall = is_first ? pass.wall : std::min(least.wall, pass.wall);
    worst = std::max(worst, pass.cpu);
  }
  void print(const char* name) const {
    std::printf(",\n  \"%s\": {\"cpu\": %.1f, \"wall\": %.1f, \"worst_cpu\": %.1f}", name,
                least.cpu, least.wall, worst);
  }
};

void print_list(const char* name, const std::vector<std::uint32_t>& numbers) {
  std::printf(" \"%s\": [", name);
  for (std::size_t i = 0; i < numbers.size(); ++i) std::printf(i == 0 ? "%u" : ", %u", numbers[i]);
  std::printf("],\n");
}

}  // namespace

void print_runtime_facts(const Bytes& stream) {
  const MemoryFacts memory = measure_memory(stream);
  PassedOverrun of_feed, of_first_surface, of_later_surfaces;
  int calls = 0;
  {
    RecyclingAllocator allocator;
    const Decoder decoder = make_decoder(allocator.callbacks());
    feed(decoder, stream, 0, stream.size());
    SurfaceBuffers buffers(decoder, memory.info.levels);
    for (int pass = 0; pass < kPasses; ++pass) {
      const Overruns overruns = measure_overruns(stream, buffers, allocator);
      of_feed.take(overruns.feed, pass == 0);
      of_first_surface.take(overruns.first_surface, pass == 0);
      of_later_surfaces.take(overruns.later_surfaces, pass == 0);
      calls += overruns.calls;
    }
  }
  std::printf("{\"bytes\": %zu, \"levels\": %d,\n", stream.size(), memory.info.levels);
  print_list("vertices", memory.vertices);
  print_list("triangles", memory.triangles);
  std::printf(" \"memory\": %.0f, \"peak\": %.0f, \"later_allocations\": %llu,\n",
              static_cast<double>(memory.info.memory), memory.peak,
              static_cast<unsigned long long>(memory.later_allocations));
  std::printf(" \"overruns\": {\"budget\": %u, \"calls\": %d", kBudget, calls);
  of_feed.print("feed");
  of_first_surface.print("first_surface");
  of_later_surfaces.print("later_surfaces");
  std::printf("}}\n");
}

}  // namespace zerotree::bench
