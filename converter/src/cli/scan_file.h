// The scan that a progressive file is measured against.
#pragma once

#include <filesystem>
#include <string>

#include "mesh/progress.h"
#include "mesh/triangle_mesh.h"

namespace zerotree::cli {

/// What `convert` was asked to change, in its options' terms; empty: nothing.
struct RequestedRepairs {
  std::string fill_holes;
  std::string remove_handles;
};

struct Scan {
  /// The surface that `convert` measures errors against: the scan as it is in its file or, where
  /// the repairs change it, the cleaned and changed one.
  TriangleMesh mesh;
  /// Bounding box diagonal of the scan as it is in its file.
  double diagonal = 0;
};

/// Throws Error naming the file or the option.
Scan read_scan(const std::filesystem::path& path, const RequestedRepairs& repairs,
               const Progress& progress);

}  // namespace zerotree::cli
