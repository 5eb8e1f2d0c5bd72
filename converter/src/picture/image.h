// A picture in memory.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace zerotree::picture {

/// Red, green, blue (sRGB) and coverage, 0..255, coverage not multiplied in.
using Pixel = std::array<std::uint8_t, 4>;

struct Image {
  int width = 0;
  int height = 0;
  /// Rows from top to bottom; width * height of them.
  std::vector<Pixel> pixels;

  Image() = default;
  Image(int image_width, int image_height, Pixel fill = {0, 0, 0, 0})
      : width(image_width),
        height(image_height),
        pixels(static_cast<std::size_t>(image_width) * static_cast<std::size_t>(image_height),
               fill) {}
  Pixel& at(int x, int y) { return pixels[static_cast<std::size_t>(y) * width + x]; }
  const Pixel& at(int x, int y) const { return pixels[static_cast<std::size_t>(y) * width + x]; }
};

/// Lays `top` over the opaque pixel `bottom`; `strength` 0..1 scales its coverage.
Pixel blend(Pixel bottom, Pixel top, float strength = 1.0F);

/// Lays `top` over the opaque `bottom` with its upper left corner at (left, upper); what lies
/// outside is cut off.
void lay_over(Image& bottom, const Image& top, int left, int upper);

/// An opaque image that shades from `upper` to `lower`, as a photographer's paper does.
Image gradient(int width, int height, Pixel upper, Pixel lower);

/// The image as the bytes of a PNG file: RGB if every pixel is opaque, else RGBA.
std::vector<std::uint8_t> png_bytes(const Image& image);

}  // namespace zerotree::picture
