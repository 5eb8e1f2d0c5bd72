// glTF and GLB: primitives, accessors, the node hierarchy, and the compressed forms.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "gltf_file_bytes.h"
#include "mesh/error.h"
#include "mesh_file_bytes.h"
#include "shapes.h"

namespace zerotree::test {
namespace {

using importer::ImportedMesh;
using nlohmann::json;

ImportedMesh import_draft(const GltfDraft& draft) {
  return import_bytes("draft.glb", draft.glb());
}

double volume(const TriangleMesh& mesh) {
  double sum = 0;
  for (const Triangle& t : mesh.triangles)
    sum += mesh.positions[t[0]].dot(mesh.positions[t[1]].cross(mesh.positions[t[2]])) / 6;
  return sum;
}

bool says(const ImportedMesh& mesh, const std::string& part) {
  return std::any_of(mesh.not_carried.begin(), mesh.not_carried.end(),
                     [&](const std::string& s) { return s.find(part) != s.npos; });
}

TEST(GltfImport, ReadsIndexedTrianglesOfAGlb) {
  const ImportedMesh m = import_draft(plain_draft(icosahedron()));
  EXPECT_EQ(m.format, "GLB");
  expect_same_mesh(m.mesh, icosahedron(), 1e-7);
  EXPECT_TRUE(m.not_carried.empty());
}

TEST(GltfImport, ReadsBuffersBesideTheFileAndInDataUris) {
  const GltfDraft draft = plain_draft(octahedron());
  // Longer than its byteLength: allowed, and common after alignment.
  write_temporary("my mesh.bin", draft.binary + "rest");
  const ImportedMesh m = import_bytes("a.gltf", draft.json_with_buffer("my%20mesh.bin"));
  EXPECT_EQ(m.format, "glTF");
  expect_same_mesh(m.mesh, octahedron(), 1e-7);

  GltfDraft triangle;  // 0 0 0, 1 0 0, 0 1 0 as floats in base64
  triangle.document["bufferViews"] = {{{"buffer", 0}, {"byteLength", 36}}};
  triangle.add_mesh({{"attributes", {{"POSITION", triangle.add_accessor(0, 5126, 3, "VEC3")}}}});
  triangle.binary.resize(36);
  const ImportedMesh t = import_bytes(
      "b.gltf", triangle.json_with_buffer("data:application/octet-stream;base64,"
                                          "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"));
  EXPECT_EQ(t.mesh.positions[2], Eigen::Vector3d(0, 1, 0));
  EXPECT_THROW(import_bytes("c.gltf", draft.json_with_buffer("missing.bin")), Error);
  EXPECT_THROW(import_bytes("d.gltf", draft.json_with_buffer("../up.bin")), Error);
}

TEST(GltfImport, BakesTheHierarchyAndKeepsTheOutsideOutside) {
  GltfDraft draft = plain_draft(octahedron());
  // Two instances under a parent: one scaled by 2, one mirrored and moved.
  const json child = {{"mesh", 0}, {"scale", {2, 2, 2}}};
  const json mirrored = {{"mesh", 0},
                         {"matrix", {-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 10, 0, 0, 1}}};
  const json parent = {{"children", {0, 1}},
                       {"translation", {0, 0, 5}},
                       {"rotation", {0, 0, 0.7071067811865476, 0.7071067811865476}}};
  draft.document["nodes"] = {child, mirrored, parent};
  draft.document["scenes"][0]["nodes"] = {2};
  const ImportedMesh m = import_draft(draft);
  ASSERT_EQ(m.mesh.positions.size(), 12u);
  EXPECT_TRUE(says(m, "hierarchy"));
  const TriangleMesh source = octahedron();
  for (std::size_t v = 0; v < 6; ++v) {
    const Eigen::Vector3d& p = source.positions[v];
    EXPECT_LT((m.mesh.positions[v] - Eigen::Vector3d(-2 * p.y(), 2 * p.x(), 2 * p.z() + 5)).norm(),
              1e-6);
    EXPECT_LT((m.mesh.positions[6 + v] - Eigen::Vector3d(-p.y(), -p.x() + 10, p.z() + 5)).norm(),
              1e-6);
  }
  EXPECT_NEAR(volume(m.mesh), 9 * volume(source), 1e-5);
}

TEST(GltfImport, ReadsStripsFansAndUnindexedTriangles) {
  const TriangleMesh square = grid(1, 1);
  for (const auto& [mode, count] : {std::pair{4, 1u}, std::pair{5, 2u}, std::pair{6, 2u}}) {
    GltfDraft draft;
    draft.add_mesh({{"attributes", {{"POSITION", draft.add_positions(square)}}}, {"mode", mode}});
    const ImportedMesh m = import_draft(draft);
    ASSERT_EQ(m.mesh.triangles.size(), count) << "mode " << mode;
    const std::vector<Triangle> strip = {{0, 1, 2}, {2, 1, 3}}, fan = {{0, 1, 2}, {0, 2, 3}};
    if (mode != 4) {
      EXPECT_EQ(m.mesh.triangles, mode == 5 ? strip : fan);
    }
  }
}

TEST(GltfImport, ReadsQuantisedPositionsWithStride) {
  GltfDraft draft;
  std::string bytes;
  for (int c : {0, 0, 0, 0, 32767, 0, 0, 0, 0, -32768, 16384, 0})
    append_bytes(bytes, static_cast<std::int16_t>(c));
  const int positions = draft.add_accessor(draft.add_view(bytes, 8), 5122, 3, "VEC3", true);
  draft.add_mesh({{"attributes", {{"POSITION", positions}}}});
  draft.document["extensionsRequired"] = {"KHR_mesh_quantization"};
  const ImportedMesh m = import_draft(draft);
  ASSERT_EQ(m.mesh.positions.size(), 3u);
  EXPECT_EQ(m.mesh.positions[1], Eigen::Vector3d(1, 0, 0));
  EXPECT_EQ(m.mesh.positions[2], Eigen::Vector3d(0, -1, 16384.0 / 32767.0));
}

TEST(GltfImport, OverlaysSparseAccessors) {
  GltfDraft draft = plain_draft(tetrahedron());
  std::string indices, values;
  append_bytes(indices, std::uint16_t{2});
  for (float c : {7.0f, 8.0f, 9.0f}) append_bytes(values, c);
  json& accessor = draft.document["accessors"][0];
  accessor["sparse"] = {
      {"count", 1},
      {"indices", {{"bufferView", draft.add_view(indices)}, {"componentType", 5123}}},
      {"values", {{"bufferView", draft.add_view(values)}}}};
  const ImportedMesh m = import_draft(draft);
  EXPECT_EQ(m.mesh.positions[2], Eigen::Vector3d(7, 8, 9));
  EXPECT_EQ(m.mesh.positions[1], tetrahedron().positions[1]);
}

TEST(GltfImport, DecodesMeshopt) {
  const ImportedMesh m = import_draft(meshopt_draft(sphere(2)));
  const TriangleMesh source = sphere(2);
  ASSERT_EQ(m.mesh.positions.size(), source.positions.size());
  ASSERT_EQ(m.mesh.triangles.size(), source.triangles.size());
  for (std::size_t v = 0; v < source.positions.size(); ++v)
    EXPECT_LT((m.mesh.positions[v] - source.positions[v]).norm(), 1e-6);
  EXPECT_NEAR(volume(m.mesh), volume(source), 1e-4);  // triangles may be rotated
}

TEST(GltfImport, DecodesDraco) {
  const ImportedMesh m = import_draft(draco_draft(sphere(2)));
  EXPECT_EQ(m.mesh.triangles.size(), sphere(2).triangles.size());
  EXPECT_NEAR(volume(m.mesh), volume(sphere(2)), 1e-3);
}

TEST(GltfImport, ReadsAttributesAndNamesWhatIsNotCarried) {
  GltfDraft draft = plain_draft(tetrahedron());
  std::string normals, colours, uvs;
  for (int v = 0; v < 4; ++v) {
    for (float c : {0.0f, 0.0f, 1.0f}) append_bytes(normals, c);
    colours += "\xff\x80\x01";
    colours += '\0';
    for (float c : {0.25f, 0.5f}) append_bytes(uvs, c);
  }
  json& attributes = draft.document["meshes"][0]["primitives"][0]["attributes"];
  attributes["NORMAL"] = draft.add_accessor(draft.add_view(normals), 5126, 4, "VEC3");
  attributes["COLOR_0"] = draft.add_accessor(draft.add_view(colours, 4), 5121, 4, "VEC3", true);
  attributes["TEXCOORD_0"] = draft.add_accessor(draft.add_view(uvs), 5126, 4, "VEC2");
  attributes["_ID"] = attributes["TEXCOORD_0"];
  draft.document["materials"] = {{{"name", "red"}}};
  const json two_primitives = plain_draft(tetrahedron()).document["meshes"][0]["primitives"][0];
  draft.document["meshes"][0]["primitives"].push_back(two_primitives);  // one without attributes
  const ImportedMesh m = import_draft(draft);
  ASSERT_EQ(m.mesh.positions.size(), 8u);
  ASSERT_EQ(m.attributes.size(), 3u);
  for (const importer::VertexAttribute& a : m.attributes) {
    EXPECT_EQ(a.values.size(), 8u * static_cast<std::size_t>(a.components)) << a.name;
    if (a.name != "COLOR_0") continue;
    EXPECT_FLOAT_EQ(a.values[1], 128.0f / 255.0f);
    EXPECT_FLOAT_EQ(a.values[16], 1.0f);  // white where there is no colour
  }
  for (const char* part : {"_ID", "Materials", "normals", "colours", "Texture coordinates"})
    EXPECT_TRUE(says(m, part)) << part;
}

TEST(GltfImport, RefusesWhatIsBroken) {
  const auto expect_refused = [](const GltfDraft& draft, const std::string& part) {
    try {
      import_draft(draft);
      ADD_FAILURE() << "was read, expected: " << part;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::unreadable_input);
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
  };
  GltfDraft draft = plain_draft(tetrahedron());
  draft.document["accessors"][0]["count"] = 1000000;
  expect_refused(draft, "buffer view 0");
  draft = plain_draft(tetrahedron());
  draft.document["accessors"][0]["count"] = 3;
  expect_refused(draft, "names vertex 3");
  draft = plain_draft(tetrahedron());
  draft.document["bufferViews"][0]["byteLength"] = 100000;
  expect_refused(draft, "outside its buffer");
  draft = plain_draft(tetrahedron());
  draft.document["nodes"][0]["children"] = {0};
  expect_refused(draft, "two parents");
  draft = plain_draft(tetrahedron());
  draft.document["nodes"][0]["mesh"] = 7;
  expect_refused(draft, "mesh 7");
  draft = plain_draft(tetrahedron());
  draft.document["extensionsRequired"] = {"EXT_unheard_of"};
  expect_refused(draft, "EXT_unheard_of");
  draft = meshopt_draft(tetrahedron());
  draft.document["bufferViews"][0]["extensions"]["EXT_meshopt_compression"]["count"] = 1u << 30;
  expect_refused(draft, "sizes that cannot be");
  const std::string glb = plain_draft(tetrahedron()).glb();
  EXPECT_THROW(import_bytes("cut.glb", glb.substr(0, glb.size() - 1)), Error);
  EXPECT_THROW(import_bytes("deep.gltf", "{\"a\":" + std::string(200000, '[')), Error);
}

}  // namespace
}  // namespace zerotree::test
