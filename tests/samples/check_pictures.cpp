// Checks pictures of three growing prefixes: check_pictures FIRST.png SECOND.png ALL.png
// Each shows a lit surface before a background, and each is closer to the last than the one before.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#define STBI_ONLY_PNG
#include <stb/stb_image.h>

namespace {

constexpr int kCaptionRows = 48;  // numbers are written there

struct Picture {
  std::string name;
  int width = 0;
  std::vector<int> grey;  // below the caption
};

Picture read_picture(const char* path) {
  Picture picture{path, 0, {}};
  int height = 0, channels = 0;
  const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
      stbi_load(path, &picture.width, &height, &channels, 1), stbi_image_free);
  if (!pixels || height <= kCaptionRows) throw std::runtime_error(picture.name + " is no picture");
  picture.grey.assign(pixels.get() + std::ptrdiff_t{kCaptionRows} * picture.width,
                      pixels.get() + std::ptrdiff_t{height} * picture.width);
  return picture;
}

/// A surface of many shades, nowhere black, mostly bright, before an even background.
void check_surface(const Picture& picture) {
  const int background = picture.grey.front();
  std::vector<int> shades(256);
  std::size_t pixels = 0, sum = 0, black = 0;
  for (const int grey : picture.grey) {
    if (std::abs(grey - background) <= 2) continue;
    ++pixels;
    ++shades[static_cast<std::size_t>(grey)];
    sum += static_cast<std::size_t>(grey);
    if (grey < 25) ++black;
  }
  const auto used = std::count_if(shades.begin(), shades.end(), [](int n) { return n > 20; });
  const std::size_t mean = sum / std::max<std::size_t>(pixels, 1);
  std::printf("%s: %zu of %zu pixels, %td shades, mean %zu, %zu black\n", picture.name.c_str(),
              pixels, picture.grey.size(), used, mean, black);
  if (pixels < picture.grey.size() / 8) throw std::runtime_error(picture.name + " is nearly blank");
  if (used < 50) throw std::runtime_error(picture.name + " is not shaded");
  if (mean < 90 || black > pixels / 200) throw std::runtime_error(picture.name + " is dark");
}

/// Mean difference of the pixels.
double difference(const Picture& a, const Picture& b) {
  if (a.width != b.width || a.grey.size() != b.grey.size())
    throw std::runtime_error(a.name + " and " + b.name + " differ in size");
  double sum = 0;
  for (std::size_t k = 0; k < a.grey.size(); ++k) sum += std::abs(a.grey[k] - b.grey[k]);
  return sum / static_cast<double>(a.grey.size());
}

void check(char** paths) {
  const Picture first = read_picture(paths[0]), second = read_picture(paths[1]),
                all = read_picture(paths[2]);
  for (const Picture* picture : {&first, &second, &all}) check_surface(*picture);
  const double far = difference(first, all), near = difference(second, all);
  std::printf("mean difference from the last: %.3f, %.3f\n", far, near);
  if (!(far > near && near > 0))
    throw std::runtime_error("the pictures do not come closer to the last one");
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fprintf(stderr, "usage: check_pictures FIRST.png SECOND.png ALL.png\n");
    return 2;
  }
  try {
    check(argv + 1);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "check_pictures: %s\n", error.what());
    return 1;
  }
  return 0;
}
