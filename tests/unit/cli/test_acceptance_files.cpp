// The command on scans of all kinds, where the folder with test meshes is at hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <set>
#include <string>
#include <system_error>
#include <vector>

#include "command_runner.h"

namespace zerotree::test {
namespace {

const std::filesystem::path kData = ZEROTREE_SHARED_DATA;

#ifdef __SANITIZE_ADDRESS__
constexpr bool kSanitized = true;
#else
constexpr bool kSanitized = false;
#endif

// Minutes each under the sanitizers: 100,000 vertices in 1,646 pieces, and 133 handles with creases
// all around, of which the base is built dozens of times.
const std::set<std::string> kSlowWhenSanitized{"dragon_vrip_res2.ply.gz", "cheese.off"};

/// The folder's files by name; a single empty name if there is none, for a test that says so.
std::vector<std::string> hostile_files() {
  std::vector<std::string> names;
  std::error_code missing;
  for (const auto& entry : std::filesystem::directory_iterator(kData / "hostile", missing))
    names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names.empty() ? std::vector<std::string>{""} : names;
}

class HostileFile : public testing::TestWithParam<std::string> {};

TEST_P(HostileFile, ConvertsOrIsRefusedWithASentenceAndNothingLeft) {
  if (GetParam().empty()) GTEST_SKIP() << "test meshes are missing: " << (kData / "hostile");
  if (kSanitized && kSlowWhenSanitized.contains(GetParam()))
    GTEST_SKIP() << "takes minutes under the sanitizers";
  const ScratchFolder folder;
  const CommandResult result = run_zerotree({"convert", (kData / "hostile" / GetParam()).string(),
                                             "-o", folder / "x.glb", "--stream", folder / "x.zt"},
                                            240);
  const bool converted = result.exit_code == 0;
  EXPECT_TRUE(converted || result.exit_code == 3 || result.exit_code == 4)
      << "ended with " << result.exit_code << ": " << result.err;
  EXPECT_EQ(std::filesystem::exists(folder / "x.glb"), converted);
  EXPECT_EQ(std::filesystem::exists(folder / "x.zt"), converted);
  if (converted) {
    EXPECT_EQ(run_zerotree({"validate", folder / "x.glb"}).exit_code, 0);
  } else {
    EXPECT_TRUE(std::filesystem::is_empty(folder.path));
    EXPECT_GT(result.err.size(), 40u);
  }
}

INSTANTIATE_TEST_SUITE_P(SharedData, HostileFile, testing::ValuesIn(hostile_files()),
                         [](const testing::TestParamInfo<std::string>& file) {
                           std::string name;
                           for (unsigned char c : file.param)
                             name.push_back(std::isalnum(c) ? static_cast<char>(c) : '_');
                           return name.empty() ? std::string("missing") : name;
                         });

}  // namespace
}  // namespace zerotree::test
