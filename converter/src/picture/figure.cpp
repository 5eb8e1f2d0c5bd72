#include "picture/figure.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "picture/caption_text.h"
#include "picture/colour_ramp.h"

namespace zerotree::picture {
namespace {

constexpr Pixel kPaperAbove{251, 251, 252, 255};
constexpr Pixel kPaperBelow{224, 227, 232, 255};
constexpr Pixel kInk{38, 42, 50, 255};
constexpr Pixel kGreyInk{96, 102, 114, 255};
constexpr double kRampWidth = 0.5;  // of the figure's
constexpr int kTickLength = 5;

class Figure {
 public:
  Figure(const Image& body, const FigureText& text)
      : text_(text),
        width_(body.width),
        line_(std::max(12, body.width / 56)),
        bold_(FontWeight::bold),
        regular_(FontWeight::regular) {
    const int header = line_ * 15 / 4;
    const int footer =
        (text.key.empty() ? 0 : 2 * line_) + (text.ticks.empty() ? 0 : line_ * 15 / 4) + line_ / 2;
    image_ = Image(width_, header + body.height + footer, kPaperBelow);
    lay_over(image_, Image(width_, header, kPaperAbove), 0, 0);
    lay_over(image_, body, 0, header);
    draw_heading();
    int top = header + body.height;
    if (!text.key.empty()) draw_key(top);
    if (!text.key.empty()) top += 2 * line_;
    if (!text.ticks.empty()) draw_ramp(top);
  }

  Image take() { return std::move(image_); }

 private:
  void draw_heading() {
    write(bold_, text_.title, line_, line_ / 2, line_ * 3 / 2, kInk);
    write(regular_, text_.subtitle, line_, line_ * 9 / 4, line_, kGreyInk);
  }

  // Text too wide for the figure is set smaller.
  void write(const CaptionFont& font, std::string_view text, int left, int top, int height,
             Pixel colour) {
    const float room = static_cast<float>(width_ - left - line_ / 2);
    const float size = static_cast<float>(height);
    const float scale = std::min(1.0F, room / std::max(1.0F, font.width(text, size)));
    font.draw(image_, text, static_cast<float>(left), static_cast<float>(top), scale * size,
              colour);
  }

  void write_centred(std::string_view text, int middle, int top) {
    const auto height = static_cast<float>(line_);
    const float left = static_cast<float>(middle) - 0.5F * regular_.width(text, height);
    regular_.draw(image_, text, left, static_cast<float>(top), height, kGreyInk);
  }

  void draw_key(int top) {
    int left = line_;
    for (const KeyEntry& entry : text_.key) {
      left += draw_sample(entry, left, top + line_) + line_ / 2;
      write(regular_, entry.text, left, top + line_ / 2, line_, kGreyInk);
      left += static_cast<int>(regular_.width(entry.text, static_cast<float>(line_))) + 2 * line_;
    }
  }

  // Returns its length.
  int draw_sample(const KeyEntry& entry, int left, int middle) {
    if (entry.is_dot) {
      const int radius = std::max(3, static_cast<int>(std::lround(0.5F * entry.width)));
      draw_disc(left + radius, middle, static_cast<float>(radius), kInk);
      draw_disc(left + radius, middle, 0.6F * static_cast<float>(radius), entry.colour);
      return 2 * radius;
    }
    const int thickness = std::max(1, static_cast<int>(std::lround(entry.width)));
    lay_over(image_, Image(2 * line_, thickness, entry.colour), left, middle - thickness / 2);
    return 2 * line_;
  }

  void draw_disc(int centre_x, int centre_y, float radius, Pixel colour) {
    const int reach = static_cast<int>(radius) + 1;
    for (int y = -reach; y <= reach; ++y)
      for (int x = -reach; x <= reach; ++x) {
        const float covered =
            radius + 0.5F - std::hypot(static_cast<float>(x), static_cast<float>(y));
        Image point(1, 1, colour);
        point.at(0, 0)[3] = static_cast<std::uint8_t>(255.0F * std::clamp(covered, 0.0F, 1.0F));
        lay_over(image_, point, centre_x + x, centre_y + y);
      }
  }

  void draw_ramp(int top) {
    const int length = static_cast<int>(kRampWidth * width_), left = (width_ - length) / 2;
    for (int x = 0; x < length; ++x)
      lay_over(image_, Image(1, line_, ramp_colour((x + 0.5) / length)), left + x, top + line_ / 4);
    const int below = top + line_ * 5 / 4;
    for (const RampTick& tick : text_.ticks) {
      const int x = left + static_cast<int>(tick.share * (length - 1));
      lay_over(image_, Image(1, kTickLength, kInk), x, below);
      write_centred(tick.text, x, below + kTickLength);
    }
    write_centred(text_.ramp_title, width_ / 2, below + kTickLength + line_ * 5 / 4);
  }

  const FigureText& text_;
  int width_;
  int line_;  // height of a line of text
  CaptionFont bold_, regular_;
  Image image_;
};

}  // namespace

Image paper(int width, int height) {
  return gradient(width, height, kPaperAbove, kPaperBelow);
}

Image figure(const Image& body, const FigureText& text) {
  return Figure(body, text).take();
}

}  // namespace zerotree::picture
