#include "validate/input_files.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "sample_assets.h"

namespace zerotree::validate {
namespace {

namespace fs = std::filesystem;

void touch(const fs::path& path) {
  fs::create_directories(path.parent_path());
  std::ofstream(path) << "x";
}

std::vector<std::string> names_of(const std::vector<InputFile>& files, const fs::path& folder) {
  std::vector<std::string> names;
  for (const InputFile& file : files)
    names.push_back(fs::relative(file.path, folder).string() + (file.problem.empty() ? "" : " !"));
  return names;
}

TEST(InputFiles, OfAFolderAreItsAssetsInOrder) {
  const test::TemporaryFolder folder;
  for (const char* name : {"b.glb", "a/z.ZT", "a/b/c.gltf", "c.glb.txt", "a/scan.ply", "B.GLB"})
    touch(folder / name);
  fs::create_directories(folder / "folder.glb");
  const auto files = find_input_files({folder.path()});
  EXPECT_EQ(names_of(files, folder.path()),
            (std::vector<std::string>{"B.GLB", "a/b/c.gltf", "a/z.ZT", "b.glb"}));
}

TEST(InputFiles, StayAsTheyAreNamed) {
  const test::TemporaryFolder folder;
  const auto files = find_input_files({folder / "z.any", folder / "missing.glb", folder / "z.any"});
  EXPECT_EQ(names_of(files, folder.path()),
            (std::vector<std::string>{"z.any", "missing.glb", "z.any"}));
}

TEST(InputFiles, OfAFolderWithoutAssetsAreAProblem) {
  const test::TemporaryFolder folder;
  touch(folder / "scan.ply");
  const auto files = find_input_files({folder.path()});
  ASSERT_EQ(files.size(), 1u);
  EXPECT_EQ(files[0].path, folder.path());
  EXPECT_NE(files[0].problem.find("holds no .glb"), std::string::npos) << files[0].problem;
}

TEST(InputFiles, DoNotFollowLinksInCircles) {
  const test::TemporaryFolder folder;
  touch(folder / "a/b.glb");
  fs::create_directory_symlink(folder.path(), folder / "a/again");
  EXPECT_EQ(find_input_files({folder.path()}).size(), 1u);
}

TEST(InputFiles, AreFoundBesideAFolderThatCannotBeSearched) {
  if (geteuid() == 0) GTEST_SKIP() << "root may search everything";
  const test::TemporaryFolder folder;
  for (const char* name : {"a.glb", "b/hidden.glb", "c/d.glb"}) touch(folder / name);
  fs::permissions(folder / "b", fs::perms::none);
  const auto files = find_input_files({folder.path()});
  fs::permissions(folder / "b", fs::perms::owner_all);
  EXPECT_EQ(names_of(files, folder.path()), (std::vector<std::string>{"a.glb", "b !", "c/d.glb"}));
}

}  // namespace
}  // namespace zerotree::validate
