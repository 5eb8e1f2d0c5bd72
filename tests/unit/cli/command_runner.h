// Runs the command `zerotree` as a user does.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "mesh/triangle_mesh.h"

namespace zerotree::test {

/// What a run ended in. A process that was killed by a signal has exit code 128 + signal.
struct CommandResult {
  int exit_code = -1;
  std::string out, err;
};

/// Runs `zerotree` with `arguments`, at most `seconds` long (exit code 124 beyond).
CommandResult run_zerotree(const std::vector<std::string>& arguments, int seconds = 120);

/// A folder that goes away with the object.
class ScratchFolder {
 public:
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  std::filesystem::path path;
  std::string operator/(const std::string& name) const { return (path / name).string(); }
};

std::vector<char> read_bytes(const std::filesystem::path& path);
/// Writes `mesh` as OFF with every digit.
void write_off(const std::filesystem::path& path, const TriangleMesh& mesh);

}  // namespace zerotree::test
