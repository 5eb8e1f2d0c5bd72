// Decodes payloads as a runtime would and looks at every surface that comes out.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "gltf/issue_table.h"
#include "gltf/progressive_asset.h"
#include "mesh/progress.h"
#include "validate/validate_options.h"

namespace zerotree::validate {

/// What decoding found out; zeros where it did not get that far.
struct PayloadFacts {
  int levels = 0;
  std::uint64_t base_vertices = 0;
  std::uint64_t base_triangles = 0;
  std::uint64_t finest_vertices = 0;
  std::uint64_t finest_triangles = 0;
  /// Prefixes whose surface was looked at.
  std::uint64_t prefixes_decoded = 0;
};

/// Where the mesh of an asset is in its file.
struct MeshPlace {
  /// JSON pointer to it.
  std::string mesh;
  /// Of each primitive one beyond its last triangle in the base mesh.
  std::vector<std::uint64_t> primitive_ends;
  /// Progressive meshes in the file: they share the cost that a plan of prefixes may have.
  std::size_t meshes_in_file = 1;
};

/// Decodes the payload of `asset` once, in ascending order of the prefixes of plan_prefixes, and
/// adds what is wrong to `issues`: a broken stream, another base's stream, positions that are not
/// finite or outside the bounds, open seams, bounds, lengths and a diagonal that make no sense.
/// Surfaces of more vertices than `options` allow are refused before memory is taken. Costs about a
/// kilobyte and 5 microseconds per base vertex, 60 bytes per finest vertex, 0.05 microseconds per
/// finest vertex and prefix (12 times as much for base vertices), and 0.17 microseconds a byte of
/// the payload.
PayloadFacts check_payload(gltf::ProgressiveAsset asset, const MeshPlace& place,
                           const ValidateOptions& options, const Progress& progress,
                           gltf::Issues& issues);

/// The same for an elementary stream with its base embedded.
PayloadFacts check_stream(std::span<const std::uint8_t> stream, const ValidateOptions& options,
                          const Progress& progress, gltf::Issues& issues);

}  // namespace zerotree::validate
