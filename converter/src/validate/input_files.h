// From the names on a command line to the files to validate.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace zerotree::validate {

/// A file to validate, or a name that leads to none.
struct InputFile {
  std::filesystem::path path;
  /// Why there is nothing to validate; empty for a file.
  std::string problem;
};

/// Files stay as they are named, whether or not they exist. A directory stands for the .glb, .gltf
/// and .zt files (in letters of any case) in it and all directories below, in ascending order of
/// their names; symbolic links to directories are not followed. A
/// directory that cannot be searched is a problem of its own, and the search goes on.
std::vector<InputFile> find_input_files(const std::vector<std::filesystem::path>& names);

}  // namespace zerotree::validate
