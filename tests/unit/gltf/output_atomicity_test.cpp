#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <string>

#include "export/atomic_file.h"
#include "gltf/gltf_document.h"
#include "gltf/progressive_reader.h"
#include "gltf/progressive_writer.h"
#include "mesh/error.h"
#include "sample_assets.h"

namespace zerotree::gltf {
namespace {

using exporter::StagedFile;
using exporter::write_file_atomically;
using test::TemporaryFolder;

std::string content(const std::filesystem::path& path) {
  const std::vector<std::uint8_t> bytes = read_file(path);
  return {bytes.begin(), bytes.end()};
}

TEST(AtomicFile, ReplacesAnExistingFile) {
  const TemporaryFolder folder;
  write_file_atomically(folder / "a", "old");
  write_file_atomically(folder / "a", "new");
  EXPECT_EQ(content(folder / "a"), "new");
  EXPECT_EQ(folder.file_names(), std::vector<std::string>{"a"});
}

TEST(AtomicFile, WithoutCommitNothingChanges) {
  const TemporaryFolder folder;
  write_file_atomically(folder / "a", "old");
  {
    StagedFile file(folder / "a");
    file.write(std::vector<std::uint8_t>(1000, 7));
    file.seal();
    EXPECT_EQ(folder.file_names().size(), 2u);
  }
  EXPECT_EQ(content(folder / "a"), "old");
  EXPECT_EQ(folder.file_names(), std::vector<std::string>{"a"});
}

TEST(AtomicFile, FollowsALinkInsteadOfReplacingIt) {
  const TemporaryFolder folder;
  write_file_atomically(folder / "a", "old");
  std::filesystem::create_symlink(folder / "a", folder / "link");
  write_file_atomically(folder / "link", "new");
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "link"));
  EXPECT_EQ(content(folder / "a"), "new");
}

TEST(AtomicFile, NewFilesHaveTheUsualPermissions) {
  const TemporaryFolder folder;
  const mode_t mask = ::umask(022);
  write_file_atomically(folder / "a", "x");
  ::umask(mask);
  struct stat status {};
  ASSERT_EQ(::stat((folder / "a").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0644u);
}

void expect_usage_error(const std::filesystem::path& path) {
  try {
    write_file_atomically(path, "x");
    FAIL() << path << " was written";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::usage);
    EXPECT_NE(std::string(error.what()).find(path.filename().string()), std::string::npos);
  }
}

TEST(AtomicFile, RefusesWhatCannotBeWritten) {
  const TemporaryFolder folder;
  expect_usage_error(folder / "missing/a.glb");
  expect_usage_error("/dev/null");
  expect_usage_error("/proc/a.glb");  // not even root may create files there
  expect_usage_error(folder.path());
}

TEST(AtomicFile, RefusesAFolderWithoutPermission) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
  const TemporaryFolder folder;
  std::filesystem::permissions(
      folder.path(), std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
  expect_usage_error(folder / "a.glb");
}

// The glTF file cannot be put in place, so the payload written before it must not stay.
TEST(SplitOutput, LeavesNothingBehindOnFailure) {
  const TemporaryFolder folder;
  const auto asset = test::sample_asset(test::base_shapes()[0], 50);
  std::filesystem::create_directory(folder / "a.glb");
  EXPECT_THROW(write_split(folder / "a.glb", asset), Error);
  EXPECT_EQ(folder.file_names(), std::vector<std::string>{"a.glb"});
  EXPECT_THROW(write_split(folder / "a.ply", asset), Error);
  EXPECT_EQ(folder.file_names(), std::vector<std::string>{"a.glb"});
}

TEST(SplitOutput, KeepsTheFilesThatWereThereOnFailure) {
  const TemporaryFolder folder;
  ProgressiveAsset asset = test::sample_asset(test::base_shapes()[0], 50);
  write_split(folder / "a.gltf", asset);
  const std::vector<std::string> names = folder.file_names();
  const std::string before = content(folder / "a.gltf") + content(folder / "a.zt.bin");
  asset.payload.clear();
  EXPECT_THROW(write_split(folder / "a.gltf", asset), Error);
  EXPECT_EQ(folder.file_names(), names);
  EXPECT_EQ(content(folder / "a.gltf") + content(folder / "a.zt.bin"), before);
}

}  // namespace
}  // namespace zerotree::gltf
