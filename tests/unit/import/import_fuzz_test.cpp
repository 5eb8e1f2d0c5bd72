// Every truncation of a small file of each format, and files with flipped bytes: a mesh or an
// Error, nothing else. Worth most under the sanitizers.
#include <gtest/gtest.h>

#include <random>

#include "gltf_file_bytes.h"
#include "mesh/error.h"
#include "mesh_file_bytes.h"
#include "shapes.h"

namespace zerotree::test {
namespace {

struct Sample {
  std::string name;
  std::string bytes;
  // Whether a shorter file is never a whole one.
  bool ends_are_noticed = false;
};

std::vector<Sample> samples() {
  const TriangleMesh mesh = octahedron();
  return {{"ascii.ply", ply_ascii_bytes(mesh), false},
          {"little.ply", ply_binary_bytes(mesh, false), true},
          {"big.ply", ply_binary_bytes(mesh, true), true},
          {"mesh.obj", obj_bytes(mesh), false},
          {"mesh.off", off_bytes(mesh), false},
          {"ascii.stl", stl_ascii_bytes(mesh), false},
          {"binary.stl", stl_binary_bytes(mesh), true},
          {"mesh.drc", draco_bytes(mesh), false},
          {"mesh.ply.gz", gzipped(ply_ascii_bytes(mesh)), true},
          {"plain.glb", plain_draft(mesh).glb(), true},
          {"draco.glb", draco_draft(mesh).glb(), true},
          {"meshopt.glb", meshopt_draft(mesh).glb(), true},
          {"mesh.gltf", plain_draft(mesh).json_with_buffer("mesh.bin"), true}};
}

importer::ImportedMesh import_from_memory(const std::string& name, const std::string& bytes) {
  const std::filesystem::path path(name);
  if (path.extension() == ".gz" || bytes.empty()) return import_bytes(name, bytes);
  // Files beside a glTF are looked for where the test has written them.
  return importer::import_mesh({temporary_folder() / path, name, path.extension(), bytes}, {}, {});
}

// Whether the bytes were read; an Error is the other good answer.
bool is_read(const std::string& name, const std::string& bytes) {
  try {
    const importer::ImportedMesh m = import_from_memory(name, bytes);
    EXPECT_FALSE(m.mesh.triangles.empty());
    for (const Triangle& t : m.mesh.triangles)
      for (std::uint32_t v : t) EXPECT_LT(v, m.mesh.positions.size());
    for (const Eigen::Vector3d& p : m.mesh.positions) EXPECT_TRUE(p.allFinite());
    return true;
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::unreadable_input);
    EXPECT_GT(std::string(error.what()).size(), name.size() + 10);
    return false;
  }
}

TEST(ImportFuzz, EveryTruncation) {
  write_temporary("mesh.bin", plain_draft(octahedron()).binary);
  for (const Sample& sample : samples()) {
    SCOPED_TRACE(sample.name);
    EXPECT_TRUE(is_read(sample.name, sample.bytes));
    for (std::size_t size = 0; size < sample.bytes.size(); ++size) {
      const bool read = is_read(sample.name, sample.bytes.substr(0, size));
      EXPECT_FALSE(read && sample.ends_are_noticed) << size << " of " << sample.bytes.size();
    }
  }
}

TEST(ImportFuzz, FlippedBytes) {
  write_temporary("mesh.bin", plain_draft(octahedron()).binary);
  std::mt19937 random(1);
  for (const Sample& sample : samples()) {
    SCOPED_TRACE(sample.name);
    for (int round = 0; round < 300; ++round) {
      std::string bytes = sample.bytes;
      for (std::uint32_t flips = 1 + random() % 4; flips > 0; --flips)
        bytes[random() % bytes.size()] = static_cast<char>(random());
      is_read(sample.name, bytes);
    }
  }
}

}  // namespace
}  // namespace zerotree::test
