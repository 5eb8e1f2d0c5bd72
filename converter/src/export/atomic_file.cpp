#include "export/atomic_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>
#include <system_error>

#include "mesh/error.h"

namespace zerotree::exporter {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(ExitCode code, const fs::path& target, const std::string& what) {
  throw Error(code, target.string() + ": " + what);
}

[[noreturn]] void fail_write(const fs::path& target, int error) {
  fail(ExitCode::internal, target,
       "cannot be written (" + std::string(std::strerror(error)) +
           "): free some space or name another place; nothing was left behind");
}

// The file that `target` names in the end; a rename onto a link would replace the link itself.
fs::path resolved(const fs::path& target) {
  if (!target.has_filename()) fail(ExitCode::usage, target, "is a folder: name a file in it");
  std::error_code error;
  const fs::file_status status = fs::status(target, error);
  if (fs::is_directory(status)) fail(ExitCode::usage, target, "is a folder: name a file in it");
  if (fs::exists(status) && !fs::is_regular_file(status))
    fail(ExitCode::usage, target, "is no regular file: name a file that may be replaced");
  return fs::exists(status) ? fs::canonical(target) : target;
}

fs::path folder_of(const fs::path& file) {
  return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

// The rename itself must reach the disk as well. Some file systems cannot do that for folders;
// the file is complete either way, so a failure here is no failure of the write.
void sync_folder(const fs::path& file) {
  const int folder = ::open(folder_of(file).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder < 0) return;
  ::fsync(folder);
  ::close(folder);
}

}  // namespace

StagedFile::StagedFile(const fs::path& target) : target_(resolved(target)) {
  std::string stem = ".";
  stem += target_.filename().string() + "." + std::to_string(::getpid());
  for (int attempt = 0; descriptor_ < 0; ++attempt) {
    temporary_ = folder_of(target_) / (stem + "-" + std::to_string(attempt) + ".tmp");
    descriptor_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor_ < 0 && errno != EEXIST)
      fail(ExitCode::usage, target_,
           "cannot be created (" + std::string(std::strerror(errno)) +
               "): name a file in a folder that exists and may be written to");
  }
}

StagedFile::~StagedFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

void StagedFile::write(std::span<const std::uint8_t> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail_write(target_, errno);
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
}

void StagedFile::seal() {
  if (descriptor_ < 0) return;
  const bool is_synced = ::fsync(descriptor_) == 0;
  const int sync_error = errno;
  const bool is_closed = ::close(descriptor_) == 0;
  const int close_error = errno;
  descriptor_ = -1;
  if (!is_synced) fail_write(target_, sync_error);
  if (!is_closed) fail_write(target_, close_error);
}

void StagedFile::commit() {
  seal();
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) fail_write(target_, errno);
  temporary_.clear();
  sync_folder(target_);
}

void write_file_atomically(const fs::path& path, std::span<const std::uint8_t> bytes) {
  StagedFile file(path);
  file.write(bytes);
  file.commit();
}

void write_file_atomically(const fs::path& path, std::string_view text) {
  write_file_atomically(path,
                        std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
}

}  // namespace zerotree::exporter
