#include "picture/caption_text.h"

#include <stb/stb_truetype.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "mesh/error.h"

namespace zerotree::picture {
namespace {

std::vector<unsigned char> read_font(FontWeight weight) {
  const std::string path =
      std::string(ZEROTREE_FONT_DIR) +
      (weight == FontWeight::bold ? "/DejaVuSans-Bold.ttf" : "/DejaVuSans.ttf");
  std::ifstream file(path, std::ios::binary);
  if (!file)
    throw Error(ExitCode::internal,
                "cannot read the font " + path + ": install the package fonts-dejavu-core");
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

// The code points of UTF-8 text; a byte that does not belong becomes U+FFFD.
std::vector<int> code_points(std::string_view text) {
  std::vector<int> points;
  for (std::size_t i = 0; i < text.size();) {
    const auto lead = static_cast<unsigned char>(text[i++]);
    const int following = lead < 0x80    ? 0
                          : lead >= 0xF0 ? 3
                          : lead >= 0xE0 ? 2
                          : lead >= 0xC0 ? 1
                                         : -1;
    int point = following <= 0 ? lead : lead & (0x3F >> following);
    int read = 0;
    while (read < following && i < text.size() && (static_cast<unsigned char>(text[i]) >> 6) == 2) {
      point = point << 6 | (static_cast<unsigned char>(text[i++]) & 0x3F);
      ++read;
    }
    points.push_back(read == following ? point : 0xFFFD);
  }
  return points;
}

}  // namespace

struct CaptionFont::Face {
  std::vector<unsigned char> file;
  stbtt_fontinfo info;

  float advance(const std::vector<int>& points, std::size_t i, float scale) const {
    int width = 0;
    stbtt_GetCodepointHMetrics(&info, points[i], &width, nullptr);
    if (i + 1 < points.size())
      width += stbtt_GetCodepointKernAdvance(&info, points[i], points[i + 1]);
    return scale * static_cast<float>(width);
  }
  void draw_glyph(Image& image, int point, float x, int baseline, float scale, Pixel colour) const;
};

CaptionFont::CaptionFont(FontWeight weight) : face_(std::make_unique<Face>()) {
  face_->file = read_font(weight);
  if (!stbtt_InitFont(&face_->info, face_->file.data(), 0))
    throw Error(ExitCode::internal,
                "the font of the package fonts-dejavu-core is damaged: install it again");
}
CaptionFont::~CaptionFont() = default;
CaptionFont::CaptionFont(CaptionFont&&) noexcept = default;

float CaptionFont::width(std::string_view text, float height) const {
  const float scale = stbtt_ScaleForPixelHeight(&face_->info, height);
  const std::vector<int> points = code_points(text);
  float sum = 0.0F;
  for (std::size_t i = 0; i < points.size(); ++i) sum += face_->advance(points, i, scale);
  return sum;
}

void CaptionFont::Face::draw_glyph(Image& image, int point, float x, int baseline, float scale,
                                   Pixel colour) const {
  const float left = std::floor(x);
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  stbtt_GetCodepointBitmapBoxSubpixel(&info, point, scale, scale, x - left, 0.0F, &x0, &y0, &x1,
                                      &y1);
  const int columns = x1 - x0, rows = y1 - y0;
  if (columns <= 0 || rows <= 0) return;
  std::vector<unsigned char> coverage(static_cast<std::size_t>(columns) * rows);
  stbtt_MakeCodepointBitmapSubpixel(&info, coverage.data(), columns, rows, columns, scale, scale,
                                    x - left, 0.0F, point);
  Image glyph(columns, rows, colour);
  for (std::size_t i = 0; i < coverage.size(); ++i)
    glyph.pixels[i][3] = static_cast<std::uint8_t>(coverage[i] * colour[3] / 255);
  lay_over(image, glyph, static_cast<int>(left) + x0, baseline + y0);
}

void CaptionFont::draw(Image& image, std::string_view text, float x, float y, float height,
                       Pixel colour) const {
  const float scale = stbtt_ScaleForPixelHeight(&face_->info, height);
  int ascent = 0;
  stbtt_GetFontVMetrics(&face_->info, &ascent, nullptr, nullptr);
  const int baseline = static_cast<int>(std::lround(y + scale * static_cast<float>(ascent)));
  const std::vector<int> points = code_points(text);
  for (std::size_t i = 0; i < points.size(); ++i) {
    face_->draw_glyph(image, points[i], x, baseline, scale, colour);
    x += face_->advance(points, i, scale);
  }
}

}  // namespace zerotree::picture
