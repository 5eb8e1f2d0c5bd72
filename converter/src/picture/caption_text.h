// Text in pictures.
#pragma once

#include <memory>
#include <string_view>

#include "picture/image.h"

namespace zerotree::picture {

enum class FontWeight { regular, bold };

/// One face of DejaVu Sans (Debian package fonts-dejavu-core), drawn by stb_truetype.
class CaptionFont {
 public:
  /// Throws Error(internal) naming the file and the package if the font is not installed.
  explicit CaptionFont(FontWeight weight);
  ~CaptionFont();
  CaptionFont(CaptionFont&&) noexcept;

  /// Width in pixels of one line of UTF-8 `text` at `height` pixels from line to line.
  float width(std::string_view text, float height) const;
  /// Draws `text` into the opaque `image` with its left end at x and its upper end at y.
  void draw(Image& image, std::string_view text, float x, float y, float height,
            Pixel colour) const;

 private:
  struct Face;
  std::unique_ptr<Face> face_;
};

}  // namespace zerotree::picture
