// Writes extension-spec/conformance.
#include <exception>
#include <filesystem>
#include <iostream>

#include "conformance_folder.h"
#include "export/atomic_file.h"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: write_conformance FOLDER\n";
    return 2;
  }
  try {
    const std::filesystem::path folder = argv[1];
    std::filesystem::create_directories(folder / "files");
    std::size_t size = 0;
    const zerotree::conformance::Folder files = zerotree::conformance::conformance_folder();
    for (const auto& [path, bytes] : files) {
      zerotree::exporter::write_file_atomically(folder / path, bytes);
      size += bytes.size();
    }
    std::cout << files.size() << " files, " << size << " bytes\n";
  } catch (const std::exception& error) {
    std::cerr << "write_conformance: " << error.what() << "\n";
    return 1;
  }
}
