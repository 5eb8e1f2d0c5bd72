// simplify_mesh IN OUT.ply FACES: the mesh with at most FACES triangles by meshoptimizer's
// simplifier, for the benchmark's "simplify, then Draco". Prints the number of triangles reached.
#include <meshoptimizer.h>

#include <cstdio>
#include <exception>
#include <string>

#include "export/atomic_file.h"
#include "export/mesh_bytes.h"
#include "import/import_mesh.h"

namespace {

zerotree::exporter::Surface simplified(const zerotree::TriangleMesh& mesh, std::size_t faces) {
  zerotree::exporter::Surface surface;
  for (const Eigen::Vector3d& p : mesh.positions) surface.positions.push_back(p.cast<float>());
  std::vector<std::uint32_t> indices;
  for (const zerotree::Triangle& t : mesh.triangles)
    indices.insert(indices.end(), t.begin(), t.end());

  constexpr float any_error = 1.0F;
  const std::size_t count = meshopt_simplify(
      indices.data(), indices.data(), indices.size(), surface.positions.data()->data(),
      surface.positions.size(), sizeof(Eigen::Vector3f), 3 * faces, any_error, 0, nullptr);
  indices.resize(count);
  const std::size_t kept = meshopt_optimizeVertexFetch(
      surface.positions.data(), indices.data(), count, surface.positions.data(),
      surface.positions.size(), sizeof(Eigen::Vector3f));
  surface.positions.resize(kept);
  for (std::size_t i = 0; i < count; i += 3)
    surface.triangles.push_back({indices[i], indices[i + 1], indices[i + 2]});
  return surface;
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 4) {
    std::fputs("usage: simplify_mesh IN OUT.ply FACES\n", stderr);
    return 2;
  }
  try {
    const zerotree::TriangleMesh mesh = zerotree::importer::import_mesh(arguments[1], {}, {}).mesh;
    const auto surface = simplified(mesh, std::stoul(arguments[3]));
    zerotree::exporter::write_file_atomically(arguments[2], zerotree::exporter::ply_bytes(surface));
    std::printf("%zu\n", surface.triangles.size());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "simplify_mesh: %s\n", error.what());
    return 1;
  }
  return 0;
}
