// Output files that are checked before they appear, and appear together.
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "convert/convert.h"

namespace zerotree::convert {

/// Refuses options that name no output, the input as an output, a folder that is not there or an
/// extension that does not fit. Throws Error(usage).
void check_outputs(const ConvertOptions& options);

/// Files being made in a hidden folder beside their target; `commit` moves them into place.
/// Destroyed without commit, it leaves nothing behind and older files as they were.
class CheckedOutput {
 public:
  /// Calls `write` with the path of the main file in the hidden folder; it may write further files
  /// beside it. Then validates the main file, which must be one of ours: .glb, .gltf or .zt.
  /// Throws what `write` throws, Error(output_failed_check) if the validator finds errors, and
  /// Error(usage) if the folder cannot be written.
  CheckedOutput(const std::filesystem::path& target,
                const std::function<void(const std::filesystem::path&)>& write);
  ~CheckedOutput();
  CheckedOutput(const CheckedOutput&) = delete;
  CheckedOutput& operator=(const CheckedOutput&) = delete;

  /// Moves all files into place, the main one last.
  void commit();

 private:
  std::filesystem::path target_, folder_;
};

}  // namespace zerotree::convert
