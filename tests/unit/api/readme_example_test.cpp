// The example of the README works, and the README shows the file that is compiled here.
#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>

#include "sample_streams.h"
#include "zerotree/zerotree.h"

extern "C" {
typedef void (*draw_function)(const float*, const float*, uint32_t, const uint32_t*, uint32_t);
zt_status draw_while_loading(const float*, uint32_t, const uint32_t*, uint32_t, int, std::FILE*,
                             draw_function);
}

namespace zerotree::test {
namespace {

std::string read_text(const std::string& path) {
  std::ifstream in(path);
  EXPECT_TRUE(in.is_open()) << path;
  return {std::istreambuf_iterator<char>(in), {}};
}

struct Drawing {
  int count = 0;
  SurfaceSamples last;
};
Drawing& drawing() {
  static Drawing only;  // the example's function pointer carries no data
  return only;
}

void draw(const float* positions, const float* normals, uint32_t vertices, const uint32_t* indices,
          uint32_t triangles) {
  ++drawing().count;
  drawing().last.positions.assign(positions, positions + 3 * vertices);
  drawing().last.normals.assign(normals, normals + 3 * vertices);
  drawing().last.indices.assign(indices, indices + 3 * triangles);
}

zt_status draw_sample(const Sample& sample, const std::vector<std::uint8_t>& payload, int levels) {
  drawing() = {};
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::tmpfile(), &std::fclose);
  // An empty vector may have no data to point to.
  if (!payload.empty()) std::fwrite(payload.data(), 1, payload.size(), file.get());
  std::rewind(file.get());
  const std::vector<std::uint32_t> indices = flat_indices(sample.base);
  return draw_while_loading(sample.stream.base_positions.data(), sample.base.vertex_count,
                            indices.data(), static_cast<std::uint32_t>(indices.size() / 3), levels,
                            file.get(), draw);
}

TEST(ReadmeExample, DrawsTheBaseAndThenEachPiece) {
  const Sample sample = sample_stream(base_shapes()[0], {false, 4, 1e-4});
  const std::vector<std::uint8_t>& payload = sample.stream.bytes;
  EXPECT_EQ(draw_sample(sample, payload, 4), ZT_DONE);
  EXPECT_EQ(drawing().count, 1 + static_cast<int>((payload.size() + 4095) / 4096));
  expect_complete(drawing().last);
  Decoder decoder = decoder_for(sample, false);
  decoder.feed(payload);
  SurfaceSamples whole;
  ASSERT_EQ(decoder.reconstruct(4, whole), ZT_OK);
  EXPECT_EQ(drawing().last.positions, whole.positions);
}

TEST(ReadmeExample, DrawsTheBaseAloneWithoutAPayload) {
  const Sample sample = sample_stream(base_shapes()[1], {false, 2});
  EXPECT_EQ(draw_sample(sample, {}, 2), ZT_MORE_BYTES_WANTED);
  EXPECT_EQ(drawing().count, 1);
  expect_complete(drawing().last);
}

TEST(ReadmeExample, EndsWithWrongInput) {
  const Sample sample = sample_stream(base_shapes()[0], {false, 2});
  EXPECT_EQ(draw_sample(sample, sample.stream.bytes, 15), ZT_BROKEN);
  EXPECT_EQ(drawing().count, 0);
  EXPECT_EQ(draw_sample(sample, {'n', 'o'}, 2), ZT_BROKEN);
  EXPECT_EQ(drawing().count, 1);
}

TEST(ReadmeExample, IsWhatTheReadmeShows) {
  const std::string root = ZEROTREE_SOURCE_DIR;
  const std::string code = read_text(root + "/tests/unit/api/readme_example.c");
  const std::string readme = read_text(root + "/README.md");
  EXPECT_NE(readme.find("```c\n" + code + "```\n"), std::string::npos)
      << "the C example of README.md, section The library, must be tests/unit/api/readme_example.c";
}

}  // namespace
}  // namespace zerotree::test
