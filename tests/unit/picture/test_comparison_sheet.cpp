#include <gtest/gtest.h>
#include <stb/stb_image.h>

#include <algorithm>
#include <cstdlib>

#include "mesh/error.h"
#include "picture/caption_text.h"
#include "picture/comparison_sheet.h"
#include "shapes.h"

namespace zerotree::picture {
namespace {

constexpr Pixel white{255, 255, 255, 255};
constexpr Pixel black{0, 0, 0, 255};

int dark_pixels(const Image& image, int left, int right) {
  int count = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = left; x < right; ++x) count += image.at(x, y)[0] < 128;
  return count;
}

TEST(CaptionText, IsAsWideAsItSays) {
  const CaptionFont font(FontWeight::bold);
  Image image(400, 40, white);
  const std::string text = "1 b/v \u00b7 4.3 kB";
  const float width = font.width(text, 30.0F);
  font.draw(image, text, 10.0F, 5.0F, 30.0F, black);
  EXPECT_GT(dark_pixels(image, 10, 10 + static_cast<int>(width)), 200);
  EXPECT_EQ(dark_pixels(image, 12 + static_cast<int>(width), 400), 0);
  font.draw(image, "cut off at every border", -20.0F, -10.0F, 60.0F, black);
  font.draw(image, "broken UTF-8 \xC3", 390.0F, 30.0F, 30.0F, black);
}

TEST(ComparisonSheet, LaysPanelsInRowsWithCaptions) {
  SheetOptions options;
  options.width = 500;
  options.columns = 2;
  const int panel = (500 - 3 * 5) / 2;
  const Image blank(panel, 60);
  const Image with = side_by_side({{blank, "A"}, {blank, ""}, {blank, "C\nsmall"}}, options);
  EXPECT_EQ(with.width, 500);
  EXPECT_GT(with.height, 2 * 60);
  EXPECT_GT(dark_pixels(with, 0, 250), 10);
  EXPECT_THROW(side_by_side({}, options), Error);
  EXPECT_THROW(side_by_side({{blank, "A"}, {Image(panel, 61), "B"}}, options), Error);
}

TEST(ComparisonSheet, PngHoldsThePixels) {
  Image image = gradient(33, 17, white, {10, 20, 30, 255});
  for (int channels : {3, 4}) {
    if (channels == 4) image.at(5, 5) = {1, 2, 3, 4};
    const std::vector<std::uint8_t> bytes = png_bytes(image);
    int width = 0, height = 0, stored = 0;
    unsigned char* decoded = stbi_load_from_memory(bytes.data(), static_cast<int>(bytes.size()),
                                                   &width, &height, &stored, 4);
    ASSERT_NE(decoded, nullptr);
    EXPECT_EQ(width, 33);
    EXPECT_EQ(height, 17);
    EXPECT_EQ(stored, channels);
    EXPECT_TRUE(std::equal(decoded, decoded + 4 * image.pixels.size(), image.pixels[0].data()));
    std::free(decoded);
  }
}

TEST(ComparisonSheet, DrawsAllMeshesWithTheFirstOnesCamera) {
  const TriangleMesh one = test::sphere(2);
  TriangleMesh half = one;
  for (Eigen::Vector3d& p : half.positions) p *= 0.5;
  SheetOptions options;
  options.width = 200;
  options.render.supersampling = 1;
  options.render.ground_shadow = false;
  const Image alone = comparison({{{&one}, ""}, {{&one}, ""}}, options);
  const Image both = comparison({{{&one}, ""}, {{&half}, ""}}, options);
  ASSERT_EQ(alone.width, both.width);
  ASSERT_EQ(alone.height, both.height);
  int left = 0, right = 0;
  for (int y = 0; y < both.height; ++y)
    for (int x = 0; x < 200; ++x) {
      if (alone.at(x, y) != both.at(x, y)) ++(x < 100 ? left : right);
    }
  EXPECT_EQ(left, 0);
  EXPECT_GT(right, 1000);  // the ring between the large and the small disc
}

}  // namespace
}  // namespace zerotree::picture
