// What to check a file for beyond the rules of the format.
#pragma once

#include <cstddef>
#include <cstdint>

#include "measure/surface_index.h"

namespace zerotree::validate {

/// What an asset may cost at most; 0: no limit.
struct Budgets {
  /// Bytes of the file and of all files it names.
  std::uint64_t max_bytes = 0;
  /// Stated error of the whole payload, relative to the source's diagonal.
  double max_error = 0;
  /// The same in metres, with the mesh where its node puts it.
  double max_error_metres = 0;
  /// Triangles of the finest level, of all progressive meshes together.
  std::uint64_t max_triangles = 0;
};

/// The mesh that a file was made of.
struct SourceScan {
  /// What the errors of the prefixes table are measured against.
  measure::SurfaceIndex surface;
  /// Bounding box diagonal of the scan as it was, before anything was changed.
  double diagonal = 0;
};

struct ValidateOptions {
  /// Largest surface to decode, in vertices of the finest level; a reader's limit, not the
  /// format's.
  std::uint64_t max_vertices = std::uint64_t{1} << 24;
  /// Prefixes to decode beside none, all bytes and those of the table; fewer of large surfaces, see
  /// plan_prefixes.
  std::size_t random_prefixes = 8;
  Budgets budgets = {};
  /// The mesh that was encoded; null: errors are not measured. Only for a file with one progressive
  /// mesh.
  const SourceScan* source = nullptr;
};

}  // namespace zerotree::validate
