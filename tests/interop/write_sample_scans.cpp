// Writes a scan of each kind for the interop tests to convert: write_sample_scans FOLDER
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>

#include "export/atomic_file.h"
#include "export/mesh_bytes.h"
#include "shapes.h"

namespace {

void write_scan(const std::filesystem::path& folder, const std::string& name,
                const zerotree::TriangleMesh& mesh) {
  zerotree::exporter::Surface surface;
  for (const Eigen::Vector3d& p : mesh.positions) surface.positions.push_back(p.cast<float>());
  surface.triangles = mesh.triangles;
  zerotree::exporter::write_file_atomically(folder / (name + ".ply"),
                                            zerotree::exporter::ply_bytes(surface));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: write_sample_scans FOLDER\n");
    return 2;
  }
  try {
    using namespace zerotree::test;
    const std::filesystem::path folder = argv[1];
    std::filesystem::create_directories(folder);
    write_scan(folder, "closed", add_bumps(sphere(3), 0.02, 4));
    write_scan(folder, "bounded", add_bumps(midpoint_subdivide(grid(4, 3), 2), 0.02, 3));
    write_scan(folder, "creased", midpoint_subdivide(voxel_surface({{0, 0, 0}, {1, 0, 0}}), 2));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "write_sample_scans: %s\n", error.what());
    return 1;
  }
  return 0;
}
