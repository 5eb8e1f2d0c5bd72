// The samples' reader of GLB files: what it reads is what was written, and hostile files are
// refused.
#include "glb_progressive.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <utility>

#include "gltf/progressive_writer.h"
#include "sample_assets.h"

namespace zerotree {
namespace {

class Loaded {
 public:
  explicit Loaded(const std::string& path)
      : is_good_(glb_progressive_load(path.c_str(), &glb_, message_.data(), message_.size())) {}
  ~Loaded() { glb_progressive_free(&glb_); }
  Loaded(const Loaded&) = delete;
  Loaded& operator=(const Loaded&) = delete;

  bool is_good() const { return is_good_ != 0; }
  std::string message() const { return message_.data(); }
  const glb_progressive* operator->() const { return &glb_; }

 private:
  glb_progressive glb_{};
  std::array<char, 256> message_{};
  int is_good_;
};

class GlbProgressive : public ::testing::Test {
 protected:
  GlbProgressive() {
    gltf::write_glb(path(), asset_);
    std::ifstream file(path(), std::ios::binary);
    bytes_.assign(std::istreambuf_iterator<char>(file), {});
  }

  std::string path() const { return (folder_ / "a.glb").string(); }
  void write(const std::string& bytes) const { std::ofstream(path(), std::ios::binary) << bytes; }
  /// The file with `other` written over the place where `text` begins.
  std::string with(const std::string& text, const std::string& other) const {
    const std::size_t place = bytes_.find(text);
    EXPECT_NE(place, std::string::npos) << text;
    return std::string(bytes_).replace(std::min(place, bytes_.size()), other.size(), other);
  }
  /// Loads, and decodes what was loaded; nothing is asked of the result but that it is safe.
  static void use(const std::string& path) {
    const Loaded glb(path);
    if (!glb.is_good()) {
      EXPECT_NE(glb.message().find(path), std::string::npos) << glb.message();
      return;
    }
    for (std::uint32_t k = 0; k < 3 * glb->triangle_count; ++k)
      ASSERT_LT(glb->indices[k], glb->vertex_count);
    zt_options options{};
    options.struct_size = sizeof options;
    options.max_vertices = 100000;
    zt_decoder* decoder = glb_progressive_decoder(glb.operator->(), &options);
    zt_feed(decoder, glb->payload, glb->payload_size);
    zt_free(decoder);
  }

  const test::TemporaryFolder folder_;
  const gltf::ProgressiveAsset asset_ = test::sample_asset(test::base_shapes().front(), 300);
  std::string bytes_;
};

TEST_F(GlbProgressive, HoldsWhatWasWritten) {
  const Loaded glb(path());
  ASSERT_TRUE(glb.is_good()) << glb.message();
  ASSERT_EQ(glb->vertex_count, asset_.control_points.size());
  for (std::size_t k = 0; k < asset_.control_points.size(); ++k)
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_EQ(glb->positions[3 * k + axis], asset_.control_points[k][axis]);
  EXPECT_EQ(glb->triangle_count, asset_.base.triangles.size());
  EXPECT_EQ(glb->levels, asset_.levels);
  EXPECT_EQ(glb->prefix_count, asset_.prefixes.size());
  EXPECT_EQ(glb->payload_size, asset_.payload.size());
}

TEST_F(GlbProgressive, IsReadAsFarAsItGoes) {
  const std::size_t cut = 100;
  write(bytes_.substr(0, bytes_.size() - cut));
  const Loaded glb(path());
  ASSERT_TRUE(glb.is_good()) << glb.message();
  EXPECT_EQ(glb->payload_size, asset_.payload.size() - cut);
}

TEST_F(GlbProgressive, OfEveryLengthIsSafe) {
  for (std::size_t size = 0; size < bytes_.size(); size += size < 40 ? 1 : 13) {
    write(bytes_.substr(0, size));
    use(path());
  }
}

TEST_F(GlbProgressive, WithAnyByteChangedIsSafe) {
  std::mt19937 random(7);
  for (int round = 0; round < 500; ++round) {
    std::string changed = bytes_;
    for (int k = 0; k < 1 + round % 3; ++k)
      changed[random() % changed.size()] =
          static_cast<char>(random() % 2 ? '0' + random() % 10 : random());
    write(changed);
    use(path());
  }
}

TEST_F(GlbProgressive, RefusesWhatReachesBeyondItsBytes) {
  for (const auto& [text, other] : {std::pair{"\"byteLength\":", "\"byteLengtx\":"},
                                    {"\"count\":", "\"count\":9"},
                                    {"\"levels\":", "\"levelx\":"},
                                    {"\"VEC3\"", "\"VEC4\""}}) {
    write(with(text, other));
    EXPECT_FALSE(Loaded(path()).is_good()) << other;
  }
}

}  // namespace
}  // namespace zerotree
