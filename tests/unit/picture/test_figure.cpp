#include "picture/figure.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "picture/colour_ramp.h"

namespace zerotree::picture {
namespace {

int brightness(Pixel p) {
  return 2 * p[0] + 7 * p[1] + p[2];
}

TEST(ColourRamp, DarkensFromEndToEnd) {
  for (int i = 0; i < 100; ++i)
    EXPECT_GT(brightness(ramp_colour(0.01 * i)), brightness(ramp_colour(0.01 * (i + 1)))) << i;
  EXPECT_EQ(ramp_colour(-1), ramp_colour(0));
  EXPECT_EQ(ramp_colour(7), ramp_colour(1));
  EXPECT_EQ(ramp_colour(std::nan("")), ramp_colour(0));
}

int dark_pixels(const Image& image, int first_row, int last_row) {
  int count = 0;
  for (int y = first_row; y < last_row; ++y)
    for (int x = 0; x < image.width; ++x) count += image.at(x, y)[1] < 128;
  return count;
}

TEST(Figure, SetsTextAboveAndTheMeaningOfColoursBelow) {
  const Image body(600, 200, {255, 255, 255, 255});
  FigureText text{"Title", "and what it is about"};
  const Image plain = figure(body, text);
  const int header = plain.height - 200 - 6;
  EXPECT_EQ(plain.width, 600);
  EXPECT_GT(dark_pixels(plain, 0, header), 100);
  EXPECT_EQ(dark_pixels(plain, header, plain.height), 0);
  text.key = {{{200, 0, 0, 255}, 3.0F, "a line"}, {{200, 0, 0, 255}, 9.0F, "a dot", true}};
  text.ramp_title = "metres";
  text.ticks = {{0.0, "0"}, {1.0, "1"}};
  const Image full = figure(body, text);
  EXPECT_GT(full.height, plain.height);
  EXPECT_GT(dark_pixels(full, header + 200, full.height), 500);
}

TEST(Figure, HasRoomForTextThatIsTooLong) {
  const std::string endless(3000, 'x');
  EXPECT_EQ(figure(Image(60, 20, {0, 0, 0, 255}), {endless, endless, {{{}, 1.0F, endless}}}).width,
            60);
}

}  // namespace
}  // namespace zerotree::picture
