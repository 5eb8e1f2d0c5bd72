#include "convert/output_files.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <string>
#include <system_error>

#include "gltf/issue_table.h"
#include "mesh/error.h"
#include "validate/file_validation.h"

namespace zerotree::convert {
namespace {

namespace fs = std::filesystem;

std::string lower_extension(const fs::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

fs::path folder_of(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

void check_target(const fs::path& target, const fs::path& input) {
  std::error_code ignored;
  if (fs::equivalent(target, input, ignored))
    throw Error(ExitCode::usage, target.string() + ": is the input; name another output file");
  if (fs::is_directory(target, ignored))
    throw Error(ExitCode::usage, target.string() + ": is a folder; name a file in it");
  if (!fs::is_directory(folder_of(target), ignored))
    throw Error(ExitCode::usage, target.string() + ": its folder does not exist; make it first");
}

fs::path make_hidden_folder(const fs::path& target) {
  std::string name = (folder_of(target) / ".zerotree-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr)
    throw Error(ExitCode::usage, target.string() +
                                     ": its folder cannot be written; choose another or change "
                                     "its permissions");
  return name;
}

void validate_output(const fs::path& written, const fs::path& target) {
  const validate::ValidationReport report = validate::validate_file(written);
  const gltf::Issue* error = gltf::first_error(report.issues);
  if (error != nullptr)
    throw Error(ExitCode::output_failed_check,
                target.string() + ": failed its own check and was not written: " +
                    gltf::issue_message(*error) + "; please report this with the input");
}

}  // namespace

void check_outputs(const ConvertOptions& options) {
  if (options.glb.empty() && options.stream.empty())
    throw Error(ExitCode::usage, "name an output: -o OUT.glb, --stream OUT.zt or both");
  for (const fs::path& target : {options.glb, options.stream})
    if (!target.empty()) check_target(target, options.input);
  if (options.glb.empty()) return;
  if (!options.stream.empty() && fs::absolute(options.glb).lexically_normal() ==
                                     fs::absolute(options.stream).lexically_normal())
    throw Error(ExitCode::usage,
                options.glb.string() + ": is named for both outputs; name two files");
  const std::string extension = lower_extension(options.glb);
  if (extension != ".glb" && !(options.split && extension == ".gltf"))
    throw Error(ExitCode::usage,
                options.glb.string() + ": name the output .glb (or .gltf together with --split)");
}

CheckedOutput::CheckedOutput(const fs::path& target,
                             const std::function<void(const fs::path&)>& write)
    : target_(target), folder_(make_hidden_folder(target)) {
  try {
    write(folder_ / target.filename());
    validate_output(folder_ / target.filename(), target);
  } catch (...) {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
    throw;
  }
}

CheckedOutput::~CheckedOutput() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

void CheckedOutput::commit() {
  for (const fs::directory_entry& file : fs::directory_iterator(folder_))
    if (file.path().filename() != target_.filename())
      fs::rename(file.path(), folder_of(target_) / file.path().filename());
  fs::rename(folder_ / target_.filename(), target_);
}

}  // namespace zerotree::convert
