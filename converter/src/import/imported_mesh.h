// What the import stage hands on: the triangles, and what else the file held.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mesh/triangle_mesh.h"

namespace zerotree::importer {

/// Limits that keep a small hostile file from asking for much memory or time.
struct ImportOptions {
  /// Bytes a compressed file (.gz, Draco, meshopt) may grow to, and that a file may have.
  std::uint64_t max_decoded_bytes = std::uint64_t{8} << 30;
  /// Vertices, and triangles, a mesh may have. Half-edges are counted in 32 bits.
  std::uint64_t max_elements = 100'000'000;
  /// Corners a single polygon may have: triangulating one takes time quadratic in them.
  std::uint64_t max_polygon_corners = 1000;
};

/// Values per vertex beside the position, named as glTF names them: NORMAL, TEXCOORD_0, COLOR_0.
/// Colours are in 0..1.
struct VertexAttribute {
  std::string name;
  int components = 0;
  /// `components` values per vertex of the mesh, back to back.
  std::vector<float> values;
};

struct ImportedMesh {
  TriangleMesh mesh;
  std::vector<VertexAttribute> attributes;
  /// One sentence for each thing of the file that later stages do not carry.
  std::vector<std::string> not_carried;
  /// "PLY (binary little endian)", "OBJ", ...
  std::string format;
  /// Counts as in the file, before polygons are cut into triangles; STL counts three vertices a
  /// face, glTF each vertex of each instance.
  std::uint64_t vertex_count = 0;
  std::uint64_t face_count = 0;
  /// Faces of more than three corners, a part of face_count.
  std::uint64_t polygon_count = 0;
};

}  // namespace zerotree::importer
