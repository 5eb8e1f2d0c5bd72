// The import stage: a file of any supported format becomes a triangle mesh.
#pragma once

#include <filesystem>

#include "import/imported_mesh.h"
#include "import/input_bytes.h"
#include "mesh/progress.h"

namespace zerotree::importer {

/// Reads PLY (ASCII, both binaries), OBJ, OFF, STL, each also gzipped, glTF and GLB (also Draco-
/// and meshopt-compressed) and Draco .drc. The format is told from the content first, from the
/// extension where the content has no mark (OBJ).
///
/// Positions are finite and every index is in range afterwards; nothing else is repaired (STL stays
/// a soup of separate triangles, repeated indices and duplicate faces stay). Throws
/// Error(unreadable_input) that names the file, the place and what to do. Linear in the file's
/// size; memory about that of the file plus the result.
ImportedMesh import_mesh(const std::filesystem::path& path, const ImportOptions& options,
                         const Progress& progress);

/// The same for a file that is in memory already, unpacked; `input.path` only tells where a glTF's
/// other files lie.
ImportedMesh import_mesh(InputBytes input, const ImportOptions& options, const Progress& progress);

}  // namespace zerotree::importer
