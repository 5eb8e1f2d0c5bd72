#include "picture/image.h"

#include <stb/stb_image_write.h>

#include <algorithm>
#include <cmath>

#include "mesh/error.h"

namespace zerotree::picture {

Pixel blend(Pixel bottom, Pixel top, float strength) {
  const float share = std::clamp(strength, 0.0F, 1.0F) * static_cast<float>(top[3]) / 255.0F;
  for (int k = 0; k < 3; ++k) {
    const float mixed = static_cast<float>(bottom[k]) * (1.0F - share) + share * top[k];
    bottom[k] = static_cast<std::uint8_t>(std::lround(mixed));
  }
  return bottom;
}

void lay_over(Image& bottom, const Image& top, int left, int upper) {
  const int first_x = std::max(0, -left), last_x = std::min(top.width, bottom.width - left);
  const int first_y = std::max(0, -upper), last_y = std::min(top.height, bottom.height - upper);
  for (int y = first_y; y < last_y; ++y)
    for (int x = first_x; x < last_x; ++x) {
      Pixel& below = bottom.at(left + x, upper + y);
      below = blend(below, top.at(x, y));
    }
}

Image gradient(int width, int height, Pixel upper, Pixel lower) {
  Image image(width, height, upper);
  for (int y = 0; y < height; ++y) {
    const float t = static_cast<float>(y) / static_cast<float>(std::max(1, height - 1));
    const Pixel row = blend(upper, {lower[0], lower[1], lower[2], 255}, t * t * (3.0F - 2.0F * t));
    for (int x = 0; x < width; ++x) image.at(x, y) = row;
  }
  return image;
}

std::vector<std::uint8_t> png_bytes(const Image& image) {
  const bool opaque =
      std::all_of(image.pixels.begin(), image.pixels.end(), [](Pixel p) { return p[3] == 255; });
  const int channels = opaque ? 3 : 4;
  std::vector<std::uint8_t> packed;
  packed.reserve(image.pixels.size() * static_cast<std::size_t>(channels));
  for (const Pixel& p : image.pixels) packed.insert(packed.end(), p.begin(), p.begin() + channels);

  std::vector<std::uint8_t> bytes;
  const auto append = [](void* context, void* data, int size) {
    const auto* first = static_cast<const std::uint8_t*>(data);
    static_cast<std::vector<std::uint8_t>*>(context)->insert(
        static_cast<std::vector<std::uint8_t>*>(context)->end(), first, first + size);
  };
  if (!stbi_write_png_to_func(append, &bytes, image.width, image.height, channels, packed.data(),
                              image.width * channels))
    throw Error(ExitCode::memory_limit, "cannot compress a picture of " +
                                            std::to_string(image.width) + " x " +
                                            std::to_string(image.height) + " pixels");
  return bytes;
}

}  // namespace zerotree::picture
