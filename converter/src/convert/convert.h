// The whole way of a scan: import, clean, domain, remesh, fit, analysis, encode, gltf, report.
#pragma once

#include <cstdint>
#include <filesystem>

#include "mesh/progress.h"
#include "report/convert_report.h"

namespace zerotree::convert {

/// Wavelet transforms to choose from.
enum class TransformChoice {
  local,      ///< surface::WaveletTransform::loop_local
  mirror,     ///< surface::WaveletTransform::loop_quadrature_mirror; slow to make
  automatic,  ///< the one with the smaller measured errors; takes both and two measurements
};

/// What to convert and how. Paths that are empty are not written; at least one of `glb` and
/// `stream` must be named.
struct ConvertOptions {
  std::filesystem::path input;
  /// The progressive glTF file, .glb (or .gltf with `split`).
  std::filesystem::path glb;
  /// The elementary stream with the base embedded, .zt.
  std::filesystem::path stream;
  /// Payload in a file of its own beside the glTF file.
  bool split = false;
  /// The base mesh takes fewer bytes, but only viewers that know KHR_mesh_quantization and
  /// EXT_meshopt_compression show it.
  bool compress_base = false;
  /// The base mesh has normals: viewers that do not know the extension shade it smoothly.
  bool base_normals = false;
  /// Vertices of the base mesh; 0: from the input's size and topology.
  int base_vertices = 0;
  /// Subdivision levels; -1: from the input's density.
  int levels = -1;
  /// Edges bent by more than this are creases; 180 switches creases off. 0: the default rule.
  double crease_angle_degrees = 0;
  /// Boundary loops with a bounding box of a shorter diagonal than this are filled (relative); 0:
  /// none.
  double fill_holes = 0;
  /// The same in metres; 0: not given.
  double fill_holes_metres = 0;
  /// Handles with a closed path shorter than this around or through them are removed (relative); 0:
  /// none.
  double remove_handles = 0;
  /// The same in metres; 0: not given.
  double remove_handles_metres = 0;
  /// Cut each stream to the shortest whose measured error is at most this (relative); 0: no cut.
  double max_error = 0;
  /// The same in metres, taken relative to the diagonal once that is known; 0: not given.
  double max_error_metres = 0;
  /// Largest size in bytes of the stream's file and of the glTF file, with `split` all its files
  /// together; 0: no limit.
  std::uint64_t target_size = 0;
  TransformChoice transform = TransformChoice::local;
  /// Threads to use; 0: one per core.
  int threads = 0;
  /// Refuse inputs that would need more memory than this, in bytes; 0: no limit.
  std::uint64_t memory_limit = 0;
  /// Folder for a picture of what each stage made (debug_pictures.h); empty: none.
  std::filesystem::path debug_pictures;
};

/// Converts and returns the report. Output files appear complete or not at all. Throws Error.
report::ConvertReport convert_file(const ConvertOptions& options, const Progress& progress);

}  // namespace zerotree::convert
