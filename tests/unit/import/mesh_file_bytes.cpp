#include "mesh_file_bytes.h"

#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <gtest/gtest.h>
#include <unistd.h>
#include <zlib.h>

#include <fstream>
#include <sstream>

namespace zerotree::test {
namespace {

std::ostringstream exact_stream() {
  std::ostringstream stream;
  stream.precision(17);
  return stream;
}

std::ostream& operator<<(std::ostream& stream, const Eigen::Vector3d& p) {
  return stream << p.x() << ' ' << p.y() << ' ' << p.z();
}

std::string ply_header(const TriangleMesh& mesh, const char* format, const char* colours) {
  std::ostringstream s;
  s << "ply\nformat " << format << " 1.0\ncomment made by a test\nelement vertex "
    << mesh.positions.size() << "\nproperty double x\nproperty double y\nproperty double z\n"
    << colours << "element face " << mesh.triangles.size()
    << "\nproperty list uchar int vertex_indices\nend_header\n";
  return s.str();
}

}  // namespace

std::string ply_ascii_bytes(const TriangleMesh& mesh) {
  std::ostringstream s = exact_stream();
  s << ply_header(mesh, "ascii", "");
  for (const Eigen::Vector3d& p : mesh.positions) s << p << '\n';
  for (const Triangle& t : mesh.triangles) s << "3 " << t[0] << ' ' << t[1] << ' ' << t[2] << '\n';
  return s.str();
}

std::string ply_binary_bytes(const TriangleMesh& mesh, bool big_endian) {
  std::string bytes = ply_header(mesh, big_endian ? "binary_big_endian" : "binary_little_endian",
                                 "property uchar red\nproperty uchar green\nproperty uchar blue\n");
  for (const Eigen::Vector3d& p : mesh.positions) {
    for (int i = 0; i < 3; ++i) append_bytes(bytes, p[i], big_endian);
    bytes += "\xff\x80\x01";
  }
  for (const Triangle& t : mesh.triangles) {
    bytes += '\3';
    for (std::uint32_t v : t) append_bytes(bytes, static_cast<std::int32_t>(v), big_endian);
  }
  return bytes;
}

std::string obj_bytes(const TriangleMesh& mesh) {
  std::ostringstream s = exact_stream();
  for (const Eigen::Vector3d& p : mesh.positions) s << "v " << p << '\n';
  for (const Triangle& t : mesh.triangles)
    s << "f " << t[0] + 1 << ' ' << t[1] + 1 << ' ' << t[2] + 1 << '\n';
  return s.str();
}

std::string off_bytes(const TriangleMesh& mesh) {
  std::ostringstream s = exact_stream();
  s << "OFF\n# a comment\n" << mesh.positions.size() << ' ' << mesh.triangles.size() << " 0\n";
  for (const Eigen::Vector3d& p : mesh.positions) s << p << '\n';
  for (const Triangle& t : mesh.triangles) s << "3 " << t[0] << ' ' << t[1] << ' ' << t[2] << '\n';
  return s.str();
}

std::string stl_ascii_bytes(const TriangleMesh& mesh) {
  std::ostringstream s = exact_stream();
  s << "solid a test's\n";
  for (const Triangle& t : mesh.triangles) {
    s << "facet normal 0 0 0\n outer loop\n";
    for (std::uint32_t v : t) s << "  vertex " << mesh.positions[v] << '\n';
    s << " endloop\nendfacet\n";
  }
  s << "endsolid a test's\n";
  return s.str();
}

std::string stl_binary_bytes(const TriangleMesh& mesh) {
  std::string bytes = "solid, though binary";  // as some programs write
  bytes.resize(80, ' ');
  append_bytes(bytes, static_cast<std::uint32_t>(mesh.triangles.size()));
  for (const Triangle& t : mesh.triangles) {
    for (int i = 0; i < 3; ++i) append_bytes(bytes, 0.0f);
    for (std::uint32_t v : t)
      for (int i = 0; i < 3; ++i) append_bytes(bytes, static_cast<float>(mesh.positions[v][i]));
    append_bytes(bytes, std::uint16_t{0});
  }
  return bytes;
}

std::string draco_bytes(const TriangleMesh& mesh) {
  draco::TriangleSoupMeshBuilder builder;
  builder.Start(static_cast<int>(mesh.triangles.size()));
  const int attribute =
      builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
  for (std::uint32_t f = 0; f < mesh.triangles.size(); ++f) {
    std::array<Eigen::Vector3f, 3> p;
    for (std::size_t k = 0; k < 3; ++k) p[k] = mesh.positions[mesh.triangles[f][k]].cast<float>();
    builder.SetAttributeValuesForFace(attribute, draco::FaceIndex(f), p[0].data(), p[1].data(),
                                      p[2].data());
  }
  const std::unique_ptr<draco::Mesh> source = builder.Finalize();
  draco::Encoder encoder;
  encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, 16);
  draco::EncoderBuffer buffer;
  if (!encoder.EncodeMeshToBuffer(*source, &buffer).ok()) return {};
  return std::string(buffer.data(), buffer.size());
}

std::string gzipped(const std::string& bytes) {
  z_stream state{};
  deflateInit2(&state, 9, Z_DEFLATED, 15 + 16, 8, Z_DEFAULT_STRATEGY);
  std::string packed(deflateBound(&state, bytes.size()) + 32, '\0');
  state.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  state.avail_in = static_cast<uInt>(bytes.size());
  state.next_out = reinterpret_cast<Bytef*>(packed.data());
  state.avail_out = static_cast<uInt>(packed.size());
  deflate(&state, Z_FINISH);
  packed.resize(state.total_out);
  deflateEnd(&state);
  return packed;
}

std::filesystem::path temporary_folder() {
  const std::filesystem::path folder =
      std::filesystem::path(testing::TempDir()) / ("zerotree_import_" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  return folder;
}

std::filesystem::path write_temporary(const std::string& name, const std::string& bytes) {
  const std::filesystem::path path = temporary_folder() / name;
  std::ofstream(path, std::ios::binary) << bytes;
  return path;
}

importer::ImportedMesh import_bytes(const std::string& name, const std::string& bytes) {
  const std::filesystem::path path = write_temporary(name, bytes);
  return importer::import_mesh(path, {}, {});
}

void expect_same_mesh(const TriangleMesh& actual, const TriangleMesh& expected, double tolerance) {
  ASSERT_EQ(actual.positions.size(), expected.positions.size());
  EXPECT_EQ(actual.triangles, expected.triangles);
  for (std::size_t v = 0; v < actual.positions.size(); ++v)
    EXPECT_LE((actual.positions[v] - expected.positions[v]).cwiseAbs().maxCoeff(), tolerance)
        << "vertex " << v;
}

}  // namespace zerotree::test
