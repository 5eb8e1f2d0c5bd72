// The caller's threads make the same surface.
#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "sample_streams.h"

namespace zerotree::test {
namespace {

constexpr int kLevels = 4;

struct Threads {
  std::atomic<int> calls{0};
  std::atomic<std::uint32_t> tasks{0};
};

/// Tasks on as many threads.
void run_on_threads(void* user, std::uint32_t count, zt_task task, void* context) {
  auto& threads = *static_cast<Threads*>(user);
  ++threads.calls;
  std::vector<std::thread> others;
  for (std::uint32_t i = 1; i < count; ++i)
    others.emplace_back([&, i] {
      ++threads.tasks;
      task(context, i);
    });
  if (count > 0) task(context, 0);
  for (std::thread& thread : others) thread.join();
}

class JobSystem : public testing::TestWithParam<Shape> {};

TEST_P(JobSystem, OfThreeThreadsMakesTheSameSurface) {
  const Sample sample = sample_stream(GetParam(), {true, kLevels, 1e-3});
  Threads threads;
  zt_options options = default_options();
  options.jobs = {&run_on_threads, &threads, 3};
  Decoder together(options), alone;
  const std::span<const std::uint8_t> bytes = sample.stream.bytes;
  for (int part = 0; part < 3; ++part) {
    const std::size_t begin = bytes.size() * part / 3, end = bytes.size() * (part + 1) / 3;
    for (Decoder* decoder : {&together, &alone}) decoder->feed(bytes.subspan(begin, end - begin));
    for (const int level : {1, kLevels}) {
      SurfaceSamples first, second;
      ASSERT_EQ(together.reconstruct(level, first), ZT_OK);
      ASSERT_EQ(alone.reconstruct(level, second), ZT_OK);
      ASSERT_EQ(first.positions, second.positions);
      ASSERT_EQ(first.normals, second.normals);
      ASSERT_EQ(first.indices, second.indices);
    }
  }
  EXPECT_GT(threads.calls, 0);
  EXPECT_GT(threads.tasks, 0u);
}

INSTANTIATE_TEST_SUITE_P(Shapes, JobSystem,
                         testing::Values(base_shapes()[2], base_shapes()[3],
                                         Shape{"sphere", sphere(1), {}, {}}),
                         [](const auto& shape) { return shape.param.name; });

// One thread is the caller's own.
TEST(JobSystemOfOneThread, IsNotCalled) {
  const Sample sample = sample_stream(base_shapes()[0], {true, 2, 1e-3});
  Threads threads;
  zt_options options = default_options();
  options.jobs = {&run_on_threads, &threads, 1};
  Decoder decoder(options);
  decoder.feed(sample.stream.bytes);
  SurfaceSamples surface;
  ASSERT_EQ(decoder.reconstruct(2, surface), ZT_OK);
  EXPECT_EQ(threads.calls, 0);
}

}  // namespace
}  // namespace zerotree::test
