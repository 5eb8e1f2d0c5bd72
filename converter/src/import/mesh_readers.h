// The readers, one per format. Each fills a PolygonMesh or throws Error(unreadable_input).
#pragma once

#include "import/input_bytes.h"
#include "import/polygon_mesh.h"

namespace zerotree::importer {

PolygonMesh read_ply(const InputBytes& input, const ImportOptions& options);
PolygonMesh read_obj(const InputBytes& input, const ImportOptions& options);
PolygonMesh read_off(const InputBytes& input, const ImportOptions& options);
PolygonMesh read_stl(const InputBytes& input, const ImportOptions& options);
PolygonMesh read_draco(const InputBytes& input, const ImportOptions& options);
/// glTF (JSON with buffers beside it or in data URIs) and GLB.
PolygonMesh read_gltf(const InputBytes& input, const ImportOptions& options);

}  // namespace zerotree::importer
