// Output files that appear complete or not at all.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>

namespace zerotree::exporter {

/// A file being written beside its target under a temporary name; `commit` renames it into place.
/// Destroyed without commit, it removes the temporary file and leaves the target as it was.
/// All functions throw Error: usage if the target cannot be created, internal if writing fails.
class StagedFile {
 public:
  /// Creates the temporary file in the folder of `target`, which must exist. A symbolic link is
  /// followed; a target that exists and is no regular file is refused.
  explicit StagedFile(const std::filesystem::path& target);
  ~StagedFile();
  StagedFile(const StagedFile&) = delete;
  StagedFile& operator=(const StagedFile&) = delete;

  /// Appends `bytes`.
  void write(std::span<const std::uint8_t> bytes);
  /// Brings all bytes to the disk and closes the file; after it only `commit` can fail. To
  /// replace several files together, seal all of them before the first commit.
  void seal();
  /// Seals, then puts the file in the target's place in one step.
  void commit();

 private:
  std::filesystem::path target_;
  std::filesystem::path temporary_;
  int descriptor_ = -1;
};

/// Writes `bytes` to `path` as one StagedFile.
void write_file_atomically(const std::filesystem::path& path, std::span<const std::uint8_t> bytes);
/// The same for text.
void write_file_atomically(const std::filesystem::path& path, std::string_view text);

}  // namespace zerotree::exporter
