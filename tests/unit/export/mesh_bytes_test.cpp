#include "export/mesh_bytes.h"

#include <gtest/gtest.h>

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <filesystem>
#include <string>

#include "export/atomic_file.h"
#include "import/import_mesh.h"
#include "mesh/error.h"
#include "shapes.h"

namespace zerotree::exporter {
namespace {

using OpenMeshSurface = OpenMesh::TriMesh_ArrayKernelT<>;

Surface surface_of(const TriangleMesh& mesh) {
  Surface surface;
  for (const Eigen::Vector3d& p : mesh.positions) {
    surface.positions.push_back(p.cast<float>());
    surface.normals.push_back(p.normalized().cast<float>());
  }
  surface.triangles = mesh.triangles;
  return surface;
}

std::filesystem::path write(const Surface& surface, const std::string& extension) {
  // Tests run side by side: each has files of its own.
  const std::string test = testing::UnitTest::GetInstance()->current_test_info()->name();
  const std::filesystem::path path =
      std::filesystem::path(testing::TempDir()).append("zerotree_" + test + extension);
  write_file_atomically(path, mesh_bytes(surface, extension));
  return path;
}

TEST(MeshBytes, AreReadByOpenMesh) {
  const Surface surface = surface_of(test::sphere(2));
  for (const std::string extension : {".ply", ".obj"}) {
    OpenMeshSurface read;
    ASSERT_TRUE(OpenMesh::IO::read_mesh(read, write(surface, extension).string())) << extension;
    ASSERT_EQ(read.n_vertices(), surface.positions.size()) << extension;
    ASSERT_EQ(read.n_faces(), surface.triangles.size()) << extension;
    for (const auto vertex : read.vertices()) {
      const auto& p = read.point(vertex);
      const auto i = static_cast<std::size_t>(vertex.idx());
      EXPECT_EQ(Eigen::Vector3f(p[0], p[1], p[2]), surface.positions[i]) << extension;
    }
  }
}

TEST(MeshBytes, ComeBackThroughTheImportStage) {
  const Surface surface = surface_of(test::add_noise(test::sphere(1), 0.2, 7));
  for (const std::string extension : {".ply", ".obj", ".glb"}) {
    const importer::ImportedMesh read = importer::import_mesh(write(surface, extension), {}, {});
    EXPECT_EQ(read.mesh.triangles, surface.triangles) << extension;
    ASSERT_EQ(read.mesh.positions.size(), surface.positions.size()) << extension;
    for (std::size_t i = 0; i < surface.positions.size(); ++i)
      EXPECT_EQ(read.mesh.positions[i].cast<float>(), surface.positions[i]) << extension;
  }
}

TEST(MeshBytes, RefuseOtherExtensions) {
  EXPECT_THROW(mesh_bytes(surface_of(test::tetrahedron()), ".stl"), Error);
}

}  // namespace
}  // namespace zerotree::exporter
