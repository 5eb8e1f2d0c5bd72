// PLY (both binaries), STL (binary) and Draco.
#include <gtest/gtest.h>

#include <algorithm>

#include "mesh_file_bytes.h"
#include "shapes.h"

namespace zerotree::test {
namespace {

using importer::ImportedMesh;

class BinaryPly : public testing::TestWithParam<bool> {};

TEST_P(BinaryPly, KeepsDoublesFacesAndColours) {
  TriangleMesh mesh = icosahedron();
  for (Eigen::Vector3d& p : mesh.positions) p *= 1.0 / 3.0;
  const ImportedMesh m = import_bytes("b.ply", ply_binary_bytes(mesh, GetParam()));
  expect_same_mesh(m.mesh, mesh, 0.0);
  EXPECT_EQ(m.format, GetParam() ? "PLY (binary big endian)" : "PLY (binary little endian)");
  ASSERT_EQ(m.attributes.size(), 1u);
  EXPECT_EQ(m.attributes[0].name, "COLOR_0");
  ASSERT_EQ(m.attributes[0].values.size(), 36u);
  EXPECT_FLOAT_EQ(m.attributes[0].values[33], 1.0f);
  EXPECT_FLOAT_EQ(m.attributes[0].values[34], 128.0f / 255.0f);
  EXPECT_FLOAT_EQ(m.attributes[0].values[35], 1.0f / 255.0f);
  ASSERT_EQ(m.not_carried.size(), 1u);
}

INSTANTIATE_TEST_SUITE_P(Endians, BinaryPly, testing::Bool());

TEST(BinaryStl, IsReadThoughItBeginsWithSolid) {
  const TriangleMesh mesh = icosahedron();
  const ImportedMesh m = import_bytes("b.stl", stl_binary_bytes(mesh));
  EXPECT_EQ(m.format, "STL (binary)");
  EXPECT_EQ(m.vertex_count, 60u);
  ASSERT_EQ(m.mesh.triangles.size(), 20u);
  for (std::size_t f = 0; f < 20; ++f)
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_EQ(m.mesh.positions[m.mesh.triangles[f][k]],
                mesh.positions[mesh.triangles[f][k]].cast<float>().cast<double>());
}

TEST(DracoFile, GivesTheMeshWithinItsQuantisation) {
  const TriangleMesh mesh = sphere(2);
  const ImportedMesh m = import_bytes("s.drc", draco_bytes(mesh));
  EXPECT_EQ(m.format, "Draco");
  ASSERT_EQ(m.mesh.positions.size(), mesh.positions.size());
  ASSERT_EQ(m.mesh.triangles.size(), mesh.triangles.size());
  for (const Eigen::Vector3d& p : m.mesh.positions) {  // Draco reorders vertices
    double nearest = 1;
    for (const Eigen::Vector3d& q : mesh.positions) nearest = std::min(nearest, (p - q).norm());
    EXPECT_LT(nearest, 1e-4);
  }
}

}  // namespace
}  // namespace zerotree::test
