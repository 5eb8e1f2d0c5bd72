// Any file of ours opened for decoding: progressive glTF or elementary stream.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "bitstream/base_topology.h"
#include "gltf/progressive_asset.h"

namespace zerotree::decode {

/// An entry of a table of measured errors.
struct MeasuredPrefix {
  std::uint64_t bytes = 0;
  /// Symmetric RMS distance relative to the source's bounding box diagonal.
  double error = 0;
};

/// A stream and what is needed to decode it.
struct StreamFile {
  /// The whole .zt file, or the payload of the glTF extension.
  std::vector<std::uint8_t> bytes;
  /// The base is not in the bytes: it is `base` with `base_positions` (x, y, z per vertex).
  bool external_base = false;
  bitstream::BaseTopology base;
  std::vector<float> base_positions;
  /// Puts what is decoded in place: a glTF mesh may lie on a grid of integers.
  gltf::Placement placement;
  /// Levels that the glTF extension states for an external base: known before the first byte.
  int levels = 0;
  /// Ascending in bytes; empty for an elementary stream, which carries no measurements.
  std::vector<MeasuredPrefix> prefixes;
  /// Bounding box diagonal of the source mesh, once put in place; 0 if not known.
  double source_diagonal = 0;
};

/// Opens a .zt, .glb or .gltf file, told apart by content. Throws Error(unreadable_input) naming
/// the file, the place and what to do.
StreamFile open_stream_file(const std::filesystem::path& path);

}  // namespace zerotree::decode
