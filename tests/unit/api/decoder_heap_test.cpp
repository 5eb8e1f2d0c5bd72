// What a decoder takes of memory and when, from the caller's allocator and behind its back.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <limits>
#include <new>

#include "caller_memory.h"
#include "sample_streams.h"

namespace {
std::atomic<std::size_t> heap_requests{0};
std::atomic<std::ptrdiff_t> heap_blocks{0};

// The request of this number fails, and all after it.
std::atomic<std::size_t> heap_end{std::numeric_limits<std::size_t>::max()};

void* from_heap(std::size_t size) {
  if (heap_requests++ >= heap_end) throw std::bad_alloc();
  ++heap_blocks;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
void to_heap(void* memory) {
  if (memory) --heap_blocks;
  std::free(memory);
}
}  // namespace

// All but the aligned ones: those of the standard library end up here, those of a sanitizer do not.
void* operator new(std::size_t size) {
  return from_heap(size);
}
void* operator new[](std::size_t size) {
  return from_heap(size);
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  try {
    return from_heap(size);
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
}
void operator delete(void* memory) noexcept {
  to_heap(memory);
}
void operator delete[](void* memory) noexcept {
  to_heap(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  to_heap(memory);
}
void operator delete[](void* memory, std::size_t) noexcept {
  to_heap(memory);
}

// Where operator new fails, OpenSubdiv forgets what it had taken for the mesh it was making.
extern "C" const char* __lsan_default_suppressions() {
  return "leak:OpenSubdiv";
}

namespace zerotree::test {
namespace {

constexpr int kLevels = 3;

/// Takes no memory itself.
zt_decoder* make_decoder(const Sample& sample, const std::vector<std::uint32_t>& indices,
                         bool embedded, const zt_options& options) {
  if (embedded) return zt_create(&options);
  return zt_create_for_base(sample.stream.base_positions.data(), 0, sample.base.vertex_count,
                            indices.data(), static_cast<std::uint32_t>(indices.size() / 3),
                            sample.levels, &options);
}

zt_decoder* make_decoder(const Sample& sample, bool embedded, const zt_options& options) {
  return make_decoder(sample, flat_indices(sample.base), embedded, options);
}

/// Each shape, with its base in the stream and without.
class DecoderHeap : public testing::TestWithParam<std::tuple<Shape, bool>> {
 protected:
  bool embedded() const { return std::get<1>(GetParam()); }
  Sample sample() const {
    return sample_stream(std::get<0>(GetParam()), {embedded(), kLevels, 1e-3});
  }
};

TEST_P(DecoderHeap, NothingIsTakenAfterTheFirstSurface) {
  const Sample sample = this->sample();
  CallerMemory memory;
  std::vector<float> positions, normals;
  zt_decoder* decoder = make_decoder(sample, embedded(), memory.options());
  ASSERT_NE(decoder, nullptr);
  const std::span<const std::uint8_t> bytes = sample.stream.bytes;
  std::size_t next = 0;
  const auto is_base_complete = [&] {
    // Sharp tags are the first that a bound stream has.
    return next >= sample.stream.pass_ends.front().bytes;
  };
  while (!is_base_complete()) zt_feed(decoder, &bytes[next++], 1);
  const std::uint32_t vertices = zt_vertex_count(decoder, kLevels);
  ASSERT_GT(vertices, 0u);
  positions.resize(3 * std::size_t{vertices});
  normals.resize(positions.size());
  ASSERT_EQ(zt_reconstruct(decoder, kLevels, positions.data(), 0, normals.data(), 0, vertices),
            ZT_OK);
  const std::size_t taken = memory.requests(), from_heap = heap_requests;
  int level = 0;
  for (std::size_t round = 0; next < bytes.size(); ++round) {
    const std::size_t size = std::min<std::size_t>(1 + round % 40, bytes.size() - next);
    std::size_t fed = size;
    if (round % 2 == 0)
      zt_feed(decoder, &bytes[next], size);
    else
      zt_feed_for(decoder, &bytes[next], size, 1, &fed);
    next += fed;
    // A coarser level needs nothing that the finest has not.
    level = static_cast<int>(round % (kLevels + 1));
    const std::uint32_t count = zt_vertex_count(decoder, level);
    if (round % 3 == 0)
      zt_reconstruct_for(decoder, level, positions.data(), 0, normals.data(), 0, count, 1);
    else
      zt_reconstruct(decoder, level, positions.data(), 0, normals.data(), 0, count);
    ASSERT_EQ(memory.requests(), taken) << "byte " << next;
    ASSERT_EQ(heap_requests, from_heap) << "byte " << next;
  }
  EXPECT_EQ(zt_get_status(decoder), ZT_DONE);
  zt_info info;
  zt_get_info(decoder, &info, sizeof info);
  EXPECT_EQ(info.memory, memory.bytes());
  zt_free(decoder);
}

TEST_P(DecoderHeap, EverythingIsGivenBack) {
  const Sample sample = this->sample();
  CallerMemory memory;
  // OpenSubdiv keeps some lists of its own from the first use on.
  for (int round = 0; round < 2; ++round) {
    const std::ptrdiff_t blocks = heap_blocks;
    zt_decoder* decoder = make_decoder(sample, embedded(), memory.options());
    zt_feed(decoder, sample.stream.bytes.data(), sample.stream.bytes.size());
    for (int level = kLevels; level >= 0; --level)
      ASSERT_EQ(
          zt_reconstruct(decoder, level, nullptr, 0, nullptr, 0, zt_vertex_count(decoder, level)),
          ZT_OK);
    float error;
    ASSERT_EQ(zt_get_level_error(decoder, 0, &error), ZT_OK);
    zt_info info;
    zt_get_info(decoder, &info, sizeof info);
    EXPECT_EQ(info.memory, memory.bytes());
    EXPECT_GT(memory.bytes(), 0u);
    zt_free(decoder);
    EXPECT_EQ(memory.bytes(), 0u);
    EXPECT_EQ(memory.blocks(), 0u);
    EXPECT_TRUE(round == 0 || heap_blocks == blocks);
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, DecoderHeap,
                         testing::Combine(testing::ValuesIn(base_shapes()), testing::Bool()),
                         [](const auto& test) {
                           return std::get<0>(test.param).name +
                                  (std::get<1>(test.param) ? "_embedded" : "_bound");
                         });

// What does not come from the caller's allocator may run out too.
TEST_P(DecoderHeap, MayEndAtAnyRequest) {
  const Sample sample = this->sample();
  const std::vector<std::uint32_t> indices = flat_indices(sample.base);
  const auto decode = [&] {
    zt_decoder* decoder = make_decoder(sample, indices, embedded(), default_options());
    if (!decoder) return false;
    const zt_status status =
        zt_feed(decoder, sample.stream.bytes.data(), sample.stream.bytes.size());
    const auto reconstruct = [&](int level) {
      return zt_reconstruct(decoder, level, nullptr, 0, nullptr, 0,
                            zt_vertex_count(decoder, level));
    };
    zt_result first = reconstruct(1), second = reconstruct(kLevels), third = reconstruct(0);
    zt_free(decoder);
    return status == ZT_DONE && first == ZT_OK && second == ZT_OK && third == ZT_OK;
  };
  ASSERT_TRUE(decode());
  std::size_t n = 0;
  for (bool is_done = false; !is_done; ++n) {
    heap_end = heap_requests + n;
    is_done = decode();
    heap_end = std::numeric_limits<std::size_t>::max();
  }
  EXPECT_GT(n, 30u);
}

// A base without sharp tags is the same before and after a stream has said so.
TEST(DecoderHeapOfASmoothBase, IsTakenBeforeTheFirstByte) {
  const Sample sample = sample_stream(base_shapes()[0], {false, kLevels, 1e-3});
  CallerMemory memory;
  zt_decoder* decoder = make_decoder(sample, false, memory.options());
  const std::uint32_t vertices = zt_vertex_count(decoder, kLevels);
  std::vector<float> positions(3 * std::size_t{vertices});
  const auto reconstruct = [&] {
    return zt_reconstruct(decoder, kLevels, positions.data(), 0, nullptr, 0, vertices);
  };
  ASSERT_EQ(reconstruct(), ZT_OK);
  ASSERT_EQ(zt_feed(decoder, sample.stream.bytes.data(), sample.stream.bytes.size()), ZT_DONE);
  const std::size_t taken = memory.requests(), from_heap = heap_requests;
  ASSERT_EQ(reconstruct(), ZT_OK);
  EXPECT_EQ(memory.requests(), taken);
  EXPECT_EQ(heap_requests, from_heap);
  zt_free(decoder);
}

TEST(DecoderBytes, AreAtMostFortyAVertex) {
  const Sample sample = sample_stream({"sphere", sphere(2), {}, {}}, {true, 5, 1e-3});
  CallerMemory memory;
  zt_decoder* decoder = make_decoder(sample, true, memory.options());
  ASSERT_EQ(zt_feed(decoder, sample.stream.bytes.data(), sample.stream.bytes.size()), ZT_DONE);
  const std::uint32_t vertices = zt_vertex_count(decoder, 5);
  ASSERT_EQ(vertices, 163842u);
  ASSERT_EQ(zt_reconstruct(decoder, 5, nullptr, 0, nullptr, 0, vertices), ZT_OK);
  const double each = static_cast<double>(memory.bytes()) / vertices;
  RecordProperty("bytes_per_vertex", std::to_string(each));
  std::cout << each << " bytes per vertex of the finest level\n";
  EXPECT_LE(each, 40.0);
  zt_free(decoder);
}

}  // namespace
}  // namespace zerotree::test
