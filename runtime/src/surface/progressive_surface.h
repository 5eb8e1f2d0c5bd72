// A stream and the surface that its bytes so far stand for.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "bitstream/stream_decoder.h"
#include "surface/subdivision_hierarchy.h"
#include "surface/surface_synthesis.h"

namespace zerotree::surface {

/// Feeding costs what decoding costs; topology is built when a surface is first asked for and
/// kept, for the deepest level asked so far. Any bytes are safe.
class ProgressiveSurface {
 public:
  explicit ProgressiveSurface(const bitstream::Limits& limits = {});
  /// For streams bound to an external base; see bitstream::StreamDecoder.
  ProgressiveSurface(bitstream::BaseTopology base, std::vector<float> positions,
                     const bitstream::Limits& limits = {});

  bitstream::DecodeStatus feed(std::span<const std::uint8_t> bytes);
  bitstream::DecodeStatus status() const;
  /// If broken, a sentence that says why; otherwise empty.
  const std::string& reason() const;
  const bitstream::StreamDecoder& decoder() const { return decoder_; }

  /// True if a surface can be made: the base is known and the stream is not broken.
  bool is_ready() const;

  struct Counts {
    std::uint64_t vertices = 0, edges = 0, triangles = 0;
  };
  /// What `level` has; `is_ready()` and 0 <= level <= header().levels.
  Counts counts(int level) const;

  /// The level's topology; null, and from then on broken, if the base is no surface.
  const SubdivisionLevel* topology(int level);
  /// Its control points from all bytes so far; only after `topology(level)` was not null.
  Positions control_points(int level) const;

 private:
  void check_header();

  bitstream::StreamDecoder decoder_;
  std::string own_reason_;
  std::unique_ptr<const SubdivisionHierarchy> hierarchy_;
};

}  // namespace zerotree::surface
