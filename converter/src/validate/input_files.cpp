#include "validate/input_files.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>
#include <system_error>
#include <utility>

namespace zerotree::validate {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 3> kExtensions = {".glb", ".gltf", ".zt"};

bool is_asset(const fs::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return std::find(kExtensions.begin(), kExtensions.end(), extension) != kExtensions.end();
}

// Adds the assets of `folder` itself to `files` and its folders to `folders`.
void search(const fs::path& folder, std::vector<InputFile>& files, std::vector<fs::path>& folders) {
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    std::error_code ignored;  // a file that has just gone is not there
    const bool is_link = entry->is_symlink(ignored);
    if (entry->is_directory(ignored)) {
      if (!is_link) folders.push_back(entry->path());
    } else if (is_asset(entry->path())) {
      files.push_back({entry->path(), {}});
    }
  }
  if (error)
    files.push_back(
        {folder, "cannot be searched (" + error.message() + "): check that it may be read"});
}

std::vector<InputFile> files_below(const fs::path& folder) {
  std::vector<InputFile> files;
  std::vector<fs::path> folders{folder};
  while (!folders.empty()) {
    const fs::path next = std::move(folders.back());
    folders.pop_back();
    search(next, files, folders);
  }
  std::sort(files.begin(), files.end(),
            [](const InputFile& a, const InputFile& b) { return a.path < b.path; });
  if (files.empty())
    files.push_back({folder, "holds no .glb, .gltf or .zt file: name another folder or a file"});
  return files;
}

}  // namespace

std::vector<InputFile> find_input_files(const std::vector<fs::path>& names) {
  std::vector<InputFile> files;
  for (const fs::path& name : names) {
    std::error_code ignored;  // what is no folder is taken for a file, and fails when it is read
    if (!fs::is_directory(name, ignored)) {
      files.push_back({name, {}});
      continue;
    }
    for (InputFile& file : files_below(name)) files.push_back(std::move(file));
  }
  return files;
}

}  // namespace zerotree::validate
