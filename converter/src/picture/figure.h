// A picture with a heading above it and the meaning of its colours below.
#pragma once

#include <string>
#include <vector>

#include "picture/image.h"

namespace zerotree::picture {

/// What a line or dot of a figure means.
struct KeyEntry {
  Pixel colour;
  /// Of the sample of it, in pixels.
  float width = 2.0F;
  std::string text;
  /// A round dot with a dark rim instead of a line.
  bool is_dot = false;
};

/// A label of the colour ramp (colour_ramp.h) at `share` of it, 0..1.
struct RampTick {
  double share = 0.0;
  std::string text;
};

/// UTF-8 text around a picture.
struct FigureText {
  std::string title;
  std::string subtitle;
  std::vector<KeyEntry> key = {};
  /// Below the ramp; both empty: no ramp.
  std::string ramp_title = {};
  std::vector<RampTick> ticks = {};
};

/// Light paper of `width` x `height` pixels, as figures and sheets use it.
Image paper(int width, int height);

/// The opaque `body` on paper between the lines of `text`. Throws Error(internal) if the captions'
/// font is not installed.
Image figure(const Image& body, const FigureText& text);

}  // namespace zerotree::picture
