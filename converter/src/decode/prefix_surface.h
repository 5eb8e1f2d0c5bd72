// The surface that a prefix of a stream stands for.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "bitstream/stream_decoder.h"
#include "decode/stream_file.h"
#include "export/mesh_bytes.h"
#include "progressive/progressive_surface.h"

namespace zerotree::decode {

/// Growing prefixes of one stream: the runtime's progressive surface with errors for a person.
class PrefixSurface {
 public:
  /// Refers to `file`, which must outlive it. `hierarchy`, if given, is that of the stream's base
  /// (sharp tags included) with at least the stream's levels; otherwise one is built when needed.
  explicit PrefixSurface(const StreamFile& file,
                         std::shared_ptr<const surface::SubdivisionHierarchy> hierarchy = nullptr);

  /// Decodes the first `bytes` bytes (all of them if there are fewer); never goes back to a
  /// shorter prefix. Throws Error(unreadable_input) if the stream is broken.
  void advance_to(std::uint64_t bytes);

  const bitstream::StreamDecoder& decoder() const { return surface_.decoder(); }
  /// As deep as the decoded details reach, and where the limit surface looks smooth.
  int automatic_level();
  /// The stream holds enough for a surface: an external base always does, an embedded one once its
  /// connectivity and sharp tags are known.
  bool has_surface() const;
  /// Limit positions, put in place, and normals at `level`, 0 to the stream's levels; at
  /// `automatic_level` if empty. Without a header, of an external base, it is the smooth surface of
  /// the base. Throws Error(unreadable_input) unless `has_surface`, and Error(usage) for a level
  /// out of range.
  /// `outward` is that of surface::LimitOutput.
  exporter::Surface surface(std::optional<int> level = {}, float outward = 0.0f);

 private:
  void require_surface() const;
  [[noreturn]] void refuse_broken() const;

  const StreamFile& file_;
  std::uint64_t fed_ = 0;
  surface::ProgressiveSurface surface_;
};

/// The triangles of a surface with positions in double, as distances are measured.
TriangleMesh to_triangle_mesh(const exporter::Surface& surface);

}  // namespace zerotree::decode
