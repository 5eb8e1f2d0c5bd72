// A stream and the surface that its bytes so far stand for.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <memory_resource>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "bitstream/stream_decoder.h"
#include "lattice/lattice_mesh.h"
#include "lattice/level_schedule.h"
#include "progressive/mesh_wide_surface.h"
#include "surface/limit_output.h"

namespace zerotree::surface {

/// A base mesh that the stream does not hold, and what its glTF file says of the stream.
struct ExternalBase {
  bitstream::BaseTopology topology;  ///< sharp tags are ignored: the stream holds them
  std::vector<float> positions;      ///< x, y, z per vertex
  int levels = 0;                    ///< a stream of another number of levels is broken
};

/// What a surface lives on. The memory outlives it.
struct SurfaceResources {
  std::pmr::memory_resource* memory = std::pmr::new_delete_resource();
  Jobs jobs;
};

/// What came of a request for a surface.
enum class SurfaceOutcome : std::uint8_t {
  done,
  unfinished,  ///< the deadline came first; the same request again goes on
  broken,      ///< the base is no surface; so is the stream, from now on
};

/// The one place where bytes become a surface. Feeding costs what decoding costs; levels are made
/// when they are first asked for, kept, and made anew from the coarsest on that has changed. Any
/// bytes are safe.
class ProgressiveSurface {
 public:
  explicit ProgressiveSurface(const bitstream::Limits& limits = {},
                              const SurfaceResources& resources = {});
  /// For streams bound to an external base; see bitstream::StreamDecoder. Broken from the start if
  /// the base is no surface or the limits do not allow its levels.
  explicit ProgressiveSurface(ExternalBase base, const bitstream::Limits& limits = {},
                              const SurfaceResources& resources = {});

  /// For the quadrature mirror transform: see MeshWideSurface::share.
  void share(std::shared_ptr<const SubdivisionHierarchy> hierarchy) {
    mesh_wide_.share(std::move(hierarchy));
  }

  bitstream::DecodeStatus feed(std::span<const std::uint8_t> bytes);
  bitstream::DecodeStatus status() const;
  /// If broken, a sentence that says why; otherwise empty.
  const std::string& reason() const;
  const bitstream::StreamDecoder& decoder() const { return decoder_; }

  /// True if a surface can be made: the stream is not broken and the base is known. An external one
  /// is from the first byte on: until its sharp tags are here, all its edges are smooth.
  bool is_ready() const;

  // The following mean something once `is_ready()`.

  /// The finest level: the header's, or until there is one what the external base's file says.
  int levels() const;
  /// The base mesh as it is known: without sharp tags as long as these are not.
  const bitstream::BaseTopology& base() const;
  /// What `level`, 0 .. levels(), has.
  LevelCounts counts(int level) const;

  /// Limit positions and normals at the vertices of `level` from all bytes so far. A stream of the
  /// quadrature mirror transform knows no deadline.
  SurfaceOutcome write_limits(int level, const LimitOutput& output, const Deadline& deadline = {});
  /// The triangles of `level`, three indices each; Index is std::uint16_t or std::uint32_t. False:
  /// broken.
  template <class Index>
  bool write_triangles(int level, Index* indices);

  /// A box that holds the surface as each level shows it. False: broken.
  struct Box {
    std::array<float, 3> low, high;
  };
  bool find_bounds(Box& box, float outward = 0.0f);
  /// Per level 0 .. levels(): how far its triangles are at most from those of the finest. Measured
  /// to kMeasuredLevel, from there on a quarter per level. Null: broken.
  static constexpr int kMeasuredLevel = 5;
  const std::vector<float>* level_errors(float outward = 0.0f);

 private:
  void fail(std::string why) { own_reason_ = std::move(why); }
  void check_external_base(int levels, const bitstream::Limits& limits);
  void check_header();
  WaveletTransform transform() const;
  Dequantisation dequantisation() const;
  LatticeMesh* mesh();
  void note_changes();
  const SurfaceSource& source();
  bool mesh_wide_points(int level, Positions& points);

  SurfaceResources resources_;
  std::optional<int> external_levels_;  ///< empty: the stream carries its base
  bitstream::StreamDecoder decoder_;    ///< holds the external base too
  std::string own_reason_;
  /// Of the base with the tags known when they were made.
  std::unique_ptr<LatticeMesh> mesh_;
  std::unique_ptr<LevelSchedule> schedule_;
  bool mesh_has_tags_ = false;
  std::vector<float> positions_;  ///< of an embedded base as they are known now
  std::array<LevelDetails, bitstream::kMostLevels> details_;
  SurfaceSource source_;
  std::vector<float> level_errors_;
  float level_errors_outward_ = 0.0f;  ///< what they were measured for
  MeshWideSurface mesh_wide_;
};

}  // namespace zerotree::surface
