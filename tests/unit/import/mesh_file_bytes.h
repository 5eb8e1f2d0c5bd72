// Mesh files made in memory, one function per format, and importing them.
#pragma once

#include <string>

#include "import/import_mesh.h"
#include "mesh/triangle_mesh.h"

namespace zerotree::test {

std::string ply_ascii_bytes(const TriangleMesh& mesh);
/// With doubles for positions, colours as bytes, and a list per face.
std::string ply_binary_bytes(const TriangleMesh& mesh, bool big_endian);
std::string obj_bytes(const TriangleMesh& mesh);
std::string off_bytes(const TriangleMesh& mesh);
std::string stl_ascii_bytes(const TriangleMesh& mesh);
std::string stl_binary_bytes(const TriangleMesh& mesh);
/// Encoded by libdraco, 16 bits for positions.
std::string draco_bytes(const TriangleMesh& mesh);
std::string gzipped(const std::string& bytes);

/// Appends the bytes of `value`.
template <class T>
void append_bytes(std::string& to, T value, bool big_endian = false) {
  const char* from = reinterpret_cast<const char*>(&value);
  for (std::size_t i = 0; i < sizeof(T); ++i) to += from[big_endian ? sizeof(T) - 1 - i : i];
}

/// A folder for this process' files: tests run side by side.
std::filesystem::path temporary_folder();
/// Writes `bytes` to a temporary file called `name` and returns its path.
std::filesystem::path write_temporary(const std::string& name, const std::string& bytes);
/// Writes and imports.
importer::ImportedMesh import_bytes(const std::string& name, const std::string& bytes);

/// Expects the same triangles over the same positions, each coordinate within `tolerance`.
void expect_same_mesh(const TriangleMesh& actual, const TriangleMesh& expected, double tolerance);

}  // namespace zerotree::test
