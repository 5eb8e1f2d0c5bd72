#include "picture/line_overlay.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "picture/mesh_picture.h"
#include "shapes.h"

namespace zerotree::picture {
namespace {

constexpr Pixel kWhite{255, 255, 255, 255}, kRed{255, 0, 0, 255};

Camera front_camera(const TriangleMesh& mesh) {
  RenderOptions options;
  options.width = options.height = 100;
  options.view_direction = {0, 0, 1};
  options.up = {0, 1, 0};
  options.margin = 0.1;
  return choose_camera(mesh, options);
}

Image draw(const TriangleMesh& mesh, const Lines& lines) {
  Image image(100, 100, kWhite);
  draw_lines(image, {lines}, mesh, front_camera(mesh));
  return image;
}

std::size_t touched(const Image& image) {
  return image.pixels.size() -
         static_cast<std::size_t>(std::count(image.pixels.begin(), image.pixels.end(), kWhite));
}

TEST(LineOverlay, DrawsWhatIsInFrontAndHidesWhatIsBehind) {
  const TriangleMesh ball = test::sphere(4);
  const Lines front{kRed, 3.0F, {{{{-0.5, 0, 1.02}, {0.5, 0, 1.02}}}}};
  const Lines behind{kRed, 3.0F, {{{{-0.5, 0, -1.02}, {0.5, 0, -1.02}}}}};
  const Image image = draw(ball, front);
  EXPECT_EQ(image.at(50, 50), kRed);
  EXPECT_EQ(image.at(50, 44), kWhite);
  EXPECT_EQ(image.at(10, 50), kWhite);
  EXPECT_EQ(touched(draw(ball, behind)), 0U);
}

TEST(LineOverlay, ASegmentWithoutLengthIsADot) {
  const Image image = draw(test::sphere(4), {kRed, 9.0F, {{{{0, 0, 1}, {0, 0, 1}}}}});
  const std::size_t area = touched(image);
  EXPECT_GT(area, 50U);
  EXPECT_LT(area, 110U);
  EXPECT_EQ(image.at(50, 50), kRed);
}

TEST(LineOverlay, WhatLeavesThePictureIsCutOff) {
  const TriangleMesh ball = test::sphere(2);
  EXPECT_GT(touched(draw(ball, {kRed, 5.0F, {{{{-40, 0, 1.2}, {40, 0, 1.2}}}}})), 400U);
}

}  // namespace
}  // namespace zerotree::picture
