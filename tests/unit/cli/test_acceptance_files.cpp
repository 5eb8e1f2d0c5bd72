// The command on scans of all kinds, where the folder with test meshes is at hand.
#include <gtest/gtest.h>

#include <filesystem>
#include <set>

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
const std::set<std::filesystem::path> kSlowWhenSanitized{"dragon_vrip_res2.ply.gz", "cheese.off"};

TEST(HostileFiles, ConvertOrAreRefusedWithASentenceAndNothingLeft) {
  if (!std::filesystem::is_directory(kData / "hostile"))
    GTEST_SKIP() << "test meshes are missing: " << (kData / "hostile");
  for (const auto& entry : std::filesystem::directory_iterator(kData / "hostile")) {
    if (kSanitized && kSlowWhenSanitized.contains(entry.path().filename())) continue;
    const TemporaryFolder folder;
    const CommandResult result = run_zerotree(
        {"convert", entry.path().string(), "-o", folder / "x.glb", "--stream", folder / "x.zt"},
        240);
    const bool converted = result.exit_code == 0;
    EXPECT_TRUE(converted || result.exit_code == 3 || result.exit_code == 4)
        << entry.path() << " ended with " << result.exit_code << ": " << result.err;
    EXPECT_EQ(std::filesystem::exists(folder / "x.glb"), converted) << entry.path();
    EXPECT_EQ(std::filesystem::exists(folder / "x.zt"), converted) << entry.path();
    if (converted) {
      EXPECT_EQ(run_zerotree({"validate", folder / "x.glb"}).exit_code, 0) << entry.path();
    } else {
      EXPECT_TRUE(std::filesystem::is_empty(folder.path)) << entry.path();
      EXPECT_GT(result.err.size(), 40u) << entry.path();
    }
  }
}

}  // namespace
}  // namespace zerotree::test
