// A stream and the surface that its bytes so far stand for.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "bitstream/stream_decoder.h"
#include "surface/subdivision_hierarchy.h"
#include "surface/surface_synthesis.h"

namespace zerotree::surface {

/// A base mesh that the stream does not hold, and what its glTF file says of the stream.
struct ExternalBase {
  bitstream::BaseTopology topology;  ///< sharp tags are ignored: the stream holds them
  std::vector<float> positions;      ///< x, y, z per vertex
  int levels = 0;                    ///< a stream of another number of levels is broken
};

/// The one place where bytes become a surface. Feeding costs what decoding costs; topology is built
/// when a surface is first asked for and kept, for the deepest level asked so far, until the
/// stream's sharp tags change it. Any bytes are safe.
class ProgressiveSurface {
 public:
  explicit ProgressiveSurface(const bitstream::Limits& limits = {});
  /// For streams bound to an external base; see bitstream::StreamDecoder. Broken from the start if
  /// the base is no surface or the limits do not allow its levels.
  explicit ProgressiveSurface(ExternalBase base, const bitstream::Limits& limits = {});

  /// A hierarchy to use wherever its transform, sharp tags and levels suffice, so that several
  /// surfaces of one base share it. Its base has this stream's triangles.
  void share(std::shared_ptr<const SubdivisionHierarchy> hierarchy);

  bitstream::DecodeStatus feed(std::span<const std::uint8_t> bytes);
  bitstream::DecodeStatus status() const;
  /// If broken, a sentence that says why; otherwise empty.
  const std::string& reason() const;
  const bitstream::StreamDecoder& decoder() const { return decoder_; }

  /// True if a surface can be made: the stream is not broken and the base is known. An external one
  /// is from the first byte on: until its sharp tags are here, all its edges are smooth.
  bool is_ready() const;

  struct Counts {
    std::uint64_t vertices = 0, edges = 0, triangles = 0;
  };
  // The following mean something once `is_ready()`.

  /// The finest level: the header's, or until there is one what the external base's file says.
  int levels() const;
  /// The base mesh as it is known: without sharp tags as long as these are not.
  const bitstream::BaseTopology& base() const;
  /// What `level`, 0 .. levels(), has.
  Counts counts(int level) const;

  /// The level's topology; null, and from then on broken, if the base is no surface.
  const SubdivisionLevel* topology(int level);
  /// Its control points from all bytes so far; only after `topology(level)` was not null.
  Positions control_points(int level) const;

 private:
  void fail(std::string why) { own_reason_ = std::move(why); }
  void check_external_base(const bitstream::Limits& limits);
  void check_header();
  WaveletTransform transform() const;
  bool suits(const SubdivisionHierarchy* hierarchy, int level) const;

  std::optional<ExternalBase> external_;
  std::size_t external_edges_ = 0;
  bitstream::StreamDecoder decoder_;
  std::string own_reason_;
  std::shared_ptr<const SubdivisionHierarchy> shared_, own_;
  /// One of the two: what `topology` last used.
  const SubdivisionHierarchy* hierarchy_ = nullptr;
};

}  // namespace zerotree::surface
