// PLY (ASCII), OBJ, OFF and STL (ASCII), and how polygons are cut.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "mesh_file_bytes.h"
#include "shapes.h"

namespace zerotree::test {
namespace {

using importer::ImportedMesh;

// Positions that no float can hold.
TriangleMesh exact_icosahedron() {
  TriangleMesh mesh = icosahedron();
  for (Eigen::Vector3d& p : mesh.positions) p *= 1.0 / 3.0;
  return mesh;
}

double area(const TriangleMesh& mesh) {
  double sum = 0;
  for (const Triangle& t : mesh.triangles)
    sum += 0.5 * (mesh.positions[t[1]] - mesh.positions[t[0]])
                     .cross(mesh.positions[t[2]] - mesh.positions[t[0]])
                     .norm();
  return sum;
}

TEST(TextFormats, KeepDoublesAndFaces) {
  const TriangleMesh mesh = exact_icosahedron();
  expect_same_mesh(import_bytes("a.ply", ply_ascii_bytes(mesh)).mesh, mesh, 0.0);
  expect_same_mesh(import_bytes("a.obj", obj_bytes(mesh)).mesh, mesh, 0.0);
  expect_same_mesh(import_bytes("a.off", off_bytes(mesh)).mesh, mesh, 0.0);
}

TEST(TextFormats, ReadGzippedUnderAnyName) {
  const TriangleMesh mesh = exact_icosahedron();
  expect_same_mesh(import_bytes("a.ply.gz", gzipped(ply_ascii_bytes(mesh))).mesh, mesh, 0.0);
  expect_same_mesh(import_bytes("b.obj.gz", gzipped(obj_bytes(mesh))).mesh, mesh, 0.0);
  expect_same_mesh(import_bytes("c.ply", gzipped(ply_ascii_bytes(mesh))).mesh, mesh, 0.0);
}

TEST(TextFormats, CountAsTheFileDoes) {
  const ImportedMesh m = import_bytes(
      "mixed.off", "OFF\n5 3 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n2 2 0\n4 0 1 2 3\n3 1 4 2\n2 0 1\n");
  EXPECT_EQ(m.format, "OFF");
  EXPECT_EQ(m.vertex_count, 5u);
  EXPECT_EQ(m.face_count, 3u);
  EXPECT_EQ(m.polygon_count, 1u);
  EXPECT_EQ(m.mesh.triangles.size(), 3u);
  ASSERT_EQ(m.not_carried.size(), 1u);
  EXPECT_NE(m.not_carried[0].find("1 face of fewer than three corners"), std::string::npos);
}

TEST(TextFormats, StlAsciiStaysSoup) {
  const TriangleMesh mesh = exact_icosahedron();
  const ImportedMesh m = import_bytes("a.stl", stl_ascii_bytes(mesh));
  ASSERT_EQ(m.mesh.positions.size(), 60u);
  ASSERT_EQ(m.mesh.triangles.size(), 20u);
  for (std::size_t f = 0; f < 20; ++f)
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_EQ(m.mesh.positions[m.mesh.triangles[f][k]], mesh.positions[mesh.triangles[f][k]]);
}

TEST(TextFormats, StlMayHoldSeveralSolids) {
  const std::string one = stl_ascii_bytes(tetrahedron());
  EXPECT_EQ(import_bytes("two.stl", one + "solid empty\nendsolid\n" + one).mesh.triangles.size(),
            8u);
}

TEST(TextFormats, QuadIsCutAlongItsShorterDiagonal) {
  const ImportedMesh m =
      import_bytes("kite.obj", "v 0 0 0\nv 3 1 0\nv 9 0 0\nv 3 -1 0\nf 4 3 2 1\n");
  ASSERT_EQ(m.mesh.triangles.size(), 2u);
  for (const Triangle& t : m.mesh.triangles) {  // the diagonal 1-3 is in both
    EXPECT_TRUE(std::find(t.begin(), t.end(), 1u) != t.end());
    EXPECT_TRUE(std::find(t.begin(), t.end(), 3u) != t.end());
  }
}

TEST(TextFormats, ConcavePolygonsAreCutInside) {
  // An arrow head whose shorter diagonal lies outside, and a comb of ten corners.
  const ImportedMesh arrow =
      import_bytes("arrow.obj", "v 0 0 0\nv 2 -1 0\nv 0 5 0\nv -2 -1 0\nf 1 2 3 4\n");
  EXPECT_NEAR(area(arrow.mesh), 10.0, 1e-12);
  const ImportedMesh comb = import_bytes(
      "comb.obj",
      "v 0 0 1\nv 5 0 1\nv 5 3 1\nv 4 3 1\nv 4 1 1\nv 3 1 1\nv 3 3 1\nv 2 3 1\nv 2 1 1\nv 1 1 1\n"
      "v 1 3 1\nv 0 3 1\nf 1 2 3 4 5 6 7 8 9 10 11 12\n");
  ASSERT_EQ(comb.mesh.triangles.size(), 10u);
  EXPECT_NEAR(area(comb.mesh), 5.0 + 3 * 2.0, 1e-12);
  for (const Triangle& t : comb.mesh.triangles) {
    const auto& p = comb.mesh.positions;
    EXPECT_GT((p[t[1]] - p[t[0]]).cross(p[t[2]] - p[t[0]]).z(), 0.0);
  }
}

TEST(TextFormats, PolygonThatCrossesItselfGivesAllItsTriangles) {
  const ImportedMesh m = import_bytes(
      "star.obj", "v 0 0 0\nv 4 3 0\nv 0 3 0\nv 4 0 0\nv 2 5 0\nv 2 5 0\nf 1 2 3 4 5 6\n");
  EXPECT_EQ(m.mesh.triangles.size(), 4u);
}

TEST(ObjReader, ReadsCornersOfEveryForm) {
  const ImportedMesh m = import_bytes(
      "forms.obj",
      "# comment\nmtllib x.mtl\no thing\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0.5\n"
      "vn 0 0 1\nusemtl m\nf 1/1/1 2/2/1 3/2/1\nf -4//1 -2//1 \\\n -1//1\nf 1/2 2/2 4/1\n");
  EXPECT_EQ(m.mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {0, 1, 3}}));
  ASSERT_EQ(m.attributes.size(), 2u);
  EXPECT_EQ(m.attributes[0].name, "TEXCOORD_0");
  EXPECT_EQ(m.attributes[0].components, 2);
  EXPECT_EQ(m.attributes[0].values, (std::vector<float>{0, 0, 1, 0.5f, 1, 0.5f, 0, 0}));
  EXPECT_EQ(m.attributes[1].name, "NORMAL");
  EXPECT_EQ(m.attributes[1].values.size(), 12u);
  EXPECT_NE(m.not_carried[0].find("At 1 face corner TEXCOORD_0"), std::string::npos);
  EXPECT_EQ(m.not_carried.size(), 5u);  // seam, names, materials, two attributes
}

TEST(ObjReader, ReadsVertexColours) {
  const ImportedMesh m =
      import_bytes("colour.obj", "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 0.5\nf 1 2 3\n");
  ASSERT_EQ(m.attributes.size(), 1u);
  EXPECT_EQ(m.attributes[0].name, "COLOR_0");
  EXPECT_EQ(m.attributes[0].values, (std::vector<float>{1, 0, 0, 0, 1, 0, 0, 0, 0.5f}));
}

TEST(OffReader, ReadsVariantsAndTrailingColours) {
  const ImportedMesh coloured = import_bytes(
      "c.off",
      "COFF # keyword\n3 1\n0 0 0 255 0 0 255\n1 0 0 0.5 0.25 1.0\n0 1 0 0 0 0 0\n3 0 1 2 9 9 9\n");
  ASSERT_EQ(coloured.attributes.size(), 1u);
  EXPECT_EQ(coloured.attributes[0].values,
            (std::vector<float>{1, 0, 0, 1, 0.5f, 0.25f, 1, 1, 0, 0, 0, 0}));
  EXPECT_EQ(coloured.not_carried[0], "Face colours are not read.");
  const ImportedMesh normals =
      import_bytes("n.off", "NOFF\n3 1 0\n0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 1 0\n3 0 1 2\n");
  ASSERT_EQ(normals.attributes.size(), 1u);
  EXPECT_EQ(normals.attributes[0].values, (std::vector<float>{0, 0, 1, 0, 0, 1, 0, 1, 0}));
}

TEST(PlyReader, SkipsWhatItDoesNotKnowAndSaysSo) {
  const ImportedMesh m = import_bytes(
      "extra.ply",
      "ply\nformat ascii 1.0\nelement camera 1\nproperty float view\nelement vertex 3\n"
      "property float x\nproperty float confidence\nproperty float y\nproperty float z\n"
      "property list uchar int rings\nelement face 1\nproperty uchar flags\n"
      "property list uchar uint vertex_index\nend_header\n7.5\n0 9 0 0 2 5 6\n1 9 0 0 0\n"
      "0 9 1 0 1 5\n4 3 0 1 2\n");
  EXPECT_EQ(m.mesh.positions[2], Eigen::Vector3d(0, 1, 0));
  EXPECT_EQ(m.mesh.triangles, (std::vector<Triangle>{{0, 1, 2}}));
  EXPECT_EQ(m.not_carried.size(), 4u);
}

TEST(PlyReader, ReadsTriangleStrips) {
  const ImportedMesh m = import_bytes(
      "strips.ply",
      "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\n"
      "property float z\nelement tristrips 1\nproperty list int int vertex_indices\nend_header\n"
      "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n10 0 1 2 3 4 -1 4 3 3 2\n");
  EXPECT_EQ(m.mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {2, 1, 3}, {2, 3, 4}}));
}

}  // namespace
}  // namespace zerotree::test
