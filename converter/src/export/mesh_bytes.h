// A decoded surface as the bytes of a mesh file.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/triangle_mesh.h"

namespace zerotree::exporter {

/// A surface ready to be written: normals are unit vectors, one per vertex, or none at all.
struct Surface {
  std::vector<Eigen::Vector3f> positions;
  std::vector<Eigen::Vector3f> normals;
  std::vector<Triangle> triangles;
};

/// Bytes of a binary little-endian PLY file with float32 positions and normals.
std::vector<std::uint8_t> ply_bytes(const Surface& surface);
/// Bytes of an OBJ file; numbers are written so that reading them returns the same floats.
std::vector<std::uint8_t> obj_bytes(const Surface& surface);
/// Bytes of a GLB file: one mesh, one node, one scene; no extensions.
std::vector<std::uint8_t> glb_bytes(const Surface& surface);

/// Bytes in the format that `extension` (".ply", ".obj", ".glb", any case) names.
/// Throws Error(usage) for any other.
std::vector<std::uint8_t> mesh_bytes(const Surface& surface, std::string_view extension);

}  // namespace zerotree::exporter
