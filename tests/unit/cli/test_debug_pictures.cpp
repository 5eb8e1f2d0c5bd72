// `convert --debug-pictures`: the files appear and show something.
#include <gtest/gtest.h>
#include <stb/stb_image.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <set>

#include "command_runner.h"
#include "shapes.h"

namespace zerotree::test {
namespace {

// Colours of a PNG file, coarsely: a blank picture on paper has a handful of greys.
std::size_t distinct_colours(const std::string& path) {
  int width = 0, height = 0, stored = 0;
  const std::unique_ptr<unsigned char, void (*)(void*)> pixels(
      stbi_load(path.c_str(), &width, &height, &stored, 3), stbi_image_free);
  if (!pixels) return 0;
  std::set<int> colours;
  for (std::ptrdiff_t i = 0; i < std::ptrdiff_t{3} * width * height; i += 3) {
    const unsigned char* p = pixels.get() + i;
    colours.insert((p[0] >> 3) << 10 | (p[1] >> 3) << 5 | p[2] >> 3);
  }
  return colours.size();
}

void expect_pictures(const TriangleMesh& mesh, const std::vector<std::string>& options) {
  const ScratchFolder folder;
  write_off(folder / "in.off", mesh);
  std::vector<std::string> command{"convert",       folder / "in.off",  "--stream",
                                   folder / "a.zt", "--debug-pictures", folder / "new/pictures"};
  command.insert(command.end(), options.begin(), options.end());
  const CommandResult result = run_zerotree(command);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  for (const std::string name : {"base", "parameter-lines", "error", "detail-energy"}) {
    const std::string path = (folder.path / "new/pictures" / (name + ".png")).string();
    EXPECT_GT(distinct_colours(path), name == "detail-energy" ? 20U : 60U) << name;
  }
}

TEST(DebugPictures, ShowAClosedSurface) {
  expect_pictures(add_bumps(sphere(3), 0.02, 4), {"--levels", "2"});
}

TEST(DebugPictures, ShowABaseWithoutLevels) {
  expect_pictures(tetrahedron(), {"--levels", "0"});
}

TEST(DebugPictures, AFolderThatCannotBeMadeIsNamedBeforeAnyWork) {
  const ScratchFolder folder;
  write_off(folder / "in.off", sphere(1));
  std::ofstream(folder / "file") << "no folder";
  const CommandResult result =
      run_zerotree({"convert", folder / "in.off", "--stream", folder / "a.zt", "--debug-pictures",
                    folder / "file/pictures"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find(folder / "file/pictures"), std::string::npos) << result.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "a.zt"));
}

}  // namespace
}  // namespace zerotree::test
