// Writes a progressive file of each mesh class for the interop tests: write_sample_glbs FOLDER
#include <cstdio>
#include <exception>
#include <filesystem>

#include "gltf/progressive_writer.h"
#include "sample_assets.h"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: write_sample_glbs FOLDER\n");
    return 2;
  }
  try {
    const std::filesystem::path folder = argv[1];
    std::filesystem::create_directories(folder);
    for (const zerotree::test::Shape& shape : zerotree::test::base_shapes()) {
      const auto asset = zerotree::test::sample_asset(shape, 1001);
      zerotree::gltf::write_glb(folder / (shape.name + ".glb"), asset);
      zerotree::gltf::write_split(folder / (shape.name + " split.glb"), asset);
      zerotree::gltf::write_split(folder / (shape.name + ".gltf"), asset);
      const auto on_grid = zerotree::test::grid_asset(shape, 1001);
      zerotree::gltf::write_glb(folder / (shape.name + "_compressed.glb"), on_grid, {true});
      zerotree::gltf::write_split(folder / (shape.name + "_compressed.gltf"), on_grid, {true});
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "write_sample_glbs: %s\n", error.what());
    return 1;
  }
  return 0;
}
