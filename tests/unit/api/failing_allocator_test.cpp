// Memory that runs out at every request there is.
#include <gtest/gtest.h>

#include <cstring>
#include <string>

#include "caller_memory.h"
#include "sample_streams.h"

namespace zerotree::test {
namespace {

constexpr int kLevels = 2;

/// An application's calls; each may fail, and everything works without those that did.
class Application {
 public:
  Application(const Sample& sample, bool embedded, CallerMemory& memory) : sample_(sample) {
    const zt_options options = memory.options();
    const std::vector<std::uint32_t> indices = flat_indices(sample.base);
    decoder_ = embedded ? zt_create(&options)
                        : zt_create_for_base(sample.stream.base_positions.data(), 0,
                                             sample.base.vertex_count, indices.data(),
                                             static_cast<std::uint32_t>(indices.size() / 3),
                                             kLevels, &options);
  }
  ~Application() { zt_free(decoder_); }
  Application(const Application&) = delete;

  zt_decoder* decoder() { return decoder_; }

  /// Runs everything; checks that what fails says why.
  void run() {
    if (!decoder_) return;
    const auto& bytes = sample_.stream.bytes;
    const std::size_t half = bytes.size() / 2;
    check(reconstruct(1));
    zt_feed(decoder_, bytes.data(), half);
    check(reconstruct(1));
    float low[3], high[3];
    check(zt_get_bounds(decoder_, low, high));
    check(reconstruct(kLevels));
    zt_feed(decoder_, &bytes[half], bytes.size() - half);
    int level = -1;
    check(zt_choose_level(decoder_, 0.01f, &level));
    check(reconstruct(kLevels));
    check(reconstruct(0));
  }

  zt_result reconstruct(int level) {
    const std::uint32_t vertices = zt_vertex_count(decoder_, level);
    surface_.assign(6 * std::size_t{vertices}, 0.0f);
    return zt_reconstruct(decoder_, level, surface_.data(), 24, surface_.data() + 3, 24, vertices);
  }
  const std::vector<float>& surface() const { return surface_; }

 private:
  void check(zt_result result) {
    zt_info info;
    zt_get_info(decoder_, &info, sizeof info);
    if (zt_get_status(decoder_) == ZT_BROKEN) {
      EXPECT_EQ(result, ZT_BROKEN_STREAM);
      EXPECT_STREQ(zt_reason(decoder_), "out of memory while decoding");
      EXPECT_EQ(info.base_ready, 0);
      EXPECT_EQ(zt_vertex_count(decoder_, 0), 0u);
    } else {
      EXPECT_TRUE(result == ZT_OK || result == ZT_OUT_OF_MEMORY || result == ZT_NOT_READY)
          << result;
    }
  }

  const Sample& sample_;
  zt_decoder* decoder_ = nullptr;
  std::vector<float> surface_;
};

class FailingAllocator : public testing::TestWithParam<std::tuple<Shape, bool>> {
 protected:
  FailingAllocator()
      : embedded_(std::get<1>(GetParam())),
        sample_(sample_stream(std::get<0>(GetParam()), {embedded_, kLevels, 1e-2})) {
    CallerMemory memory;
    Application application(sample_, embedded_, memory);
    application.run();
    EXPECT_EQ(application.reconstruct(kLevels), ZT_OK);
    surface_ = application.surface();
    requests_ = memory.requests();
  }

  bool embedded_;
  Sample sample_;
  std::vector<float> surface_;
  std::size_t requests_ = 0;
};

TEST_P(FailingAllocator, FromAnyRequestOnIsSafe) {
  ASSERT_GT(requests_, 20u);
  for (std::size_t n = 0; n < requests_; ++n) {
    SCOPED_TRACE(n);
    CallerMemory memory;
    memory.refuse(n, CallerMemory::kNever);
    {
      Application application(sample_, embedded_, memory);
      EXPECT_EQ(application.decoder() == nullptr, n == 0 || memory.blocks() == 0);
      application.run();
    }
    ASSERT_EQ(memory.bytes(), 0u);
    ASSERT_EQ(memory.blocks(), 0u);
  }
}

// What failed once works later, and rightly: all but feeding, which does not keep its bytes.
TEST_P(FailingAllocator, OnceIsNoHarm) {
  int recovered = 0;
  for (std::size_t n = 0; n < requests_; ++n) {
    SCOPED_TRACE(n);
    CallerMemory memory;
    memory.refuse(n, n);
    {
      Application application(sample_, embedded_, memory);
      application.run();
      if (application.decoder() && zt_get_status(application.decoder()) != ZT_BROKEN) {
        ++recovered;
        ASSERT_EQ(application.reconstruct(kLevels), ZT_OK);
        ASSERT_EQ(application.surface(), surface_);
      }
    }
    ASSERT_EQ(memory.blocks(), 0u);
  }
  EXPECT_GT(recovered, 20);
}

INSTANTIATE_TEST_SUITE_P(Shapes, FailingAllocator,
                         testing::Combine(testing::Values(base_shapes()[1], base_shapes()[2]),
                                          testing::Bool()),
                         [](const auto& test) {
                           return std::get<0>(test.param).name +
                                  (std::get<1>(test.param) ? "_embedded" : "_bound");
                         });

}  // namespace
}  // namespace zerotree::test
