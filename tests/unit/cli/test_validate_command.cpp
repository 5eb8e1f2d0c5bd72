// `zerotree validate`: exit codes, reports, measuring against the scan.
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>

#include "command_runner.h"
#include "encoded_assets.h"
#include "gltf/glb_container.h"
#include "gltf/progressive_writer.h"
#include "shapes.h"

namespace zerotree::test {
namespace {

using nlohmann::json;

// A right file and what a build folder holds beside it.
class ValidateCommand : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    files_ = new ScratchFolder;
    const Shape shape = base_shapes()[0];
    write(file("good.glb"), gltf::glb_bytes(encoded_asset(shape)));
    write(file("good.zt"), encoded_stream(shape));
    std::ofstream(file("plain.gltf")) << R"({"asset":{"version":"2.0"}})";
    std::ofstream(file("text.glb")) << "no glTF";
    const std::vector<char> bytes = read_bytes(file("good.glb"));
    write(file("cut.glb"), std::vector<char>(bytes.begin(), bytes.end() - 20));
    std::filesystem::create_directories(file("empty"));
  }
  static void TearDownTestSuite() { delete files_; }

  static std::string file(const std::string& name) { return *files_ / name; }
  template <class Byte>
  static void write(const std::string& path, const std::vector<Byte>& bytes) {
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
  }
  static CommandResult validate(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "validate");
    return run_zerotree(arguments);
  }
  // A file with its JSON changed.
  static void write_changed(const std::string& from, const std::string& path,
                            const std::function<void(json&)>& change) {
    const std::vector<char> whole = read_bytes(from);
    const std::vector<std::uint8_t> bytes(whole.begin(), whole.end());
    const gltf::GlbChunks chunks = gltf::split_glb(bytes);
    json root = json::parse(chunks.json);
    change(root);
    const std::vector<std::uint8_t> head = gltf::glb_head(root.dump(), chunks.binary.size());
    std::vector<char> changed(head.begin(), head.end());
    changed.insert(changed.end(), chunks.binary.begin(), chunks.binary.end());
    write(path, changed);
  }
  static json& table(json& root) {
    return root["meshes"][0]["extensions"]["ZEROTREE_mesh_progressive"]["prefixes"];
  }

 private:
  static ScratchFolder* files_;
};

ScratchFolder* ValidateCommand::files_ = nullptr;

TEST_F(ValidateCommand, EndsWithZeroWithoutErrors) {
  EXPECT_EQ(validate({file("good.glb"), file("good.zt"), file("plain.gltf")}).exit_code, 0);
  const CommandResult plain = validate({file("plain.gltf")});
  EXPECT_EQ(plain.exit_code, 0);
  EXPECT_NE(plain.out.find("info EXTENSION_ABSENT"), std::string::npos);
}

TEST_F(ValidateCommand, EndsWithOneWithErrors) {
  EXPECT_EQ(validate({file("text.glb")}).exit_code, 1);
  EXPECT_EQ(validate({file("cut.glb")}).exit_code, 1);
  const CommandResult many = validate({file("good.glb"), file("cut.glb"), file("good.zt")});
  EXPECT_EQ(many.exit_code, 1);
  EXPECT_NE(many.out.find("good.zt: 0 errors, 0 warnings\n"), std::string::npos) << many.out;
  EXPECT_NE(many.out.find("\n3 files: 2 errors, 0 warnings\n"), std::string::npos) << many.out;
}

TEST_F(ValidateCommand, EndsWithTwoWhereItCouldNotRun) {
  EXPECT_EQ(validate({}).exit_code, 2);
  EXPECT_EQ(validate({"--frobnicate", file("good.glb")}).exit_code, 2);
  EXPECT_EQ(validate({file("empty")}).exit_code, 2);
  const CommandResult long_name = validate({std::string(300, 'a')});
  EXPECT_EQ(long_name.exit_code, 2);
  EXPECT_EQ(std::count(long_name.err.begin(), long_name.err.end(), '\n'), 1) << long_name.err;
  EXPECT_EQ(validate({file("good.glb"), "-o", file("no/such/report.json")}).exit_code, 2);
  EXPECT_EQ(validate({file("good.glb"), "--max-error", "much"}).exit_code, 2);
  EXPECT_EQ(validate({file("good.glb"), "--max-bytes", "0"}).exit_code, 2);
  const CommandResult missing = validate({file("missing.glb")});
  EXPECT_EQ(missing.exit_code, 2);
  EXPECT_TRUE(missing.err.starts_with("zerotree: ")) << missing.err;
  EXPECT_NE(missing.err.find("missing.glb"), std::string::npos) << missing.err;
}

TEST_F(ValidateCommand, GoesOnAfterAFileThatCannotBeRead) {
  const CommandResult result =
      validate({file("missing.glb"), file("cut.glb"), file("good.glb"), "-o", file("report.json")});
  EXPECT_EQ(result.exit_code, 2) << "2 wins over 1";
  const json report = json::parse(std::ifstream(file("report.json")));
  ASSERT_EQ(report.size(), 3u);
  EXPECT_EQ(report[0]["uri"], file("missing.glb"));
  EXPECT_EQ(report[0]["issues"]["numErrors"], 1);
  EXPECT_EQ(report[1]["issues"]["numErrors"], 2);
  EXPECT_EQ(report[2]["issues"]["numErrors"], 0);
}

TEST_F(ValidateCommand, EndsWithTwoForWhatIsNoFile) {
  ASSERT_EQ(mkfifo(file("pipe.glb").c_str(), 0600), 0);
  const CommandResult result = validate({file("pipe.glb"), file("good.glb")});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("pipe.glb: is no file"), std::string::npos) << result.err;
  EXPECT_NE(result.out.find("pipe.glb: could not be read\n"), std::string::npos) << result.out;
}

TEST_F(ValidateCommand, EndsWithTwoForAFileWithoutPermission) {
  if (geteuid() == 0) GTEST_SKIP() << "root may read everything";
  write(file("secret.glb"), read_bytes(file("good.glb")));
  std::filesystem::permissions(file("secret.glb"), std::filesystem::perms::none);
  EXPECT_EQ(validate({file("secret.glb")}).exit_code, 2);
}

TEST_F(ValidateCommand, SearchesFolders) {
  const ScratchFolder folder;
  std::filesystem::create_directories(folder.path / "a");
  for (const char* name : {"z.glb", "a/b.glb"}) write(folder / name, read_bytes(file("good.glb")));
  const CommandResult result = validate({folder.path.string(), "-o", file("folder.json")});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const json report = json::parse(std::ifstream(file("folder.json")));
  ASSERT_EQ(report.size(), 2u);
  EXPECT_EQ(report[0]["uri"], folder / "a/b.glb");
  // A folder of one file gives an array too: what reads it need not know how many there are.
  EXPECT_EQ(validate({(folder.path / "a").string(), "-o", file("folder.json")}).exit_code, 0);
  EXPECT_TRUE(json::parse(std::ifstream(file("folder.json"))).is_array());
  EXPECT_EQ(validate({folder / "z.glb", "-o", file("one.json")}).exit_code, 0);
  EXPECT_TRUE(json::parse(std::ifstream(file("one.json"))).is_object());
}

TEST_F(ValidateCommand, KeepsBudgets) {
  const auto size = std::filesystem::file_size(file("good.glb"));
  const std::string good = file("good.glb");
  EXPECT_EQ(validate({good, "--max-bytes", std::to_string(size)}).exit_code, 0);
  EXPECT_EQ(validate({good, "--max-bytes", "1M", "--max-error", "0.1", "--max-triangles", "100000"})
                .exit_code,
            0);
  const CommandResult bytes = validate({good, "--max-bytes", "1k"});
  EXPECT_EQ(bytes.exit_code, 1);
  EXPECT_NE(bytes.out.find("BUDGET_BYTES"), std::string::npos) << bytes.out;
  EXPECT_NE(bytes.out.find(std::to_string(size) + " bytes, allowed are 1000"), std::string::npos);
  EXPECT_EQ(validate({good, "--max-triangles", "10"}).exit_code, 1);
  EXPECT_EQ(validate({good, "--max-error", "1e-9"}).exit_code, 1);
  EXPECT_EQ(validate({good, "--max-error", "0.001mm"}).exit_code, 1);
  EXPECT_EQ(validate({file("good.zt"), "--max-error", "0.1"}).exit_code, 1);
}

TEST_F(ValidateCommand, PrintsErrorsOnlyIfAsked) {
  const CommandResult good = validate({"--quiet", file("good.glb"), file("plain.gltf")});
  EXPECT_EQ(good.out + good.err, "");
  const CommandResult bad = validate({"-q", file("good.glb"), file("text.glb")});
  EXPECT_EQ(bad.exit_code, 1);
  EXPECT_TRUE(bad.out.starts_with(file("text.glb") + ": error ")) << bad.out;
  EXPECT_EQ(std::count(bad.out.begin(), bad.out.end(), '\n'), 1) << bad.out;
}

TEST_F(ValidateCommand, WritesReportsOfNamesThatAreNoText) {
  const std::string odd = file("odd\xff<&>.glb");
  write(odd, read_bytes(file("good.glb")));
  const CommandResult result =
      validate({odd, file("cut.glb"), "--junit", file("odd.xml"), "-o", file("odd.json")});
  EXPECT_EQ(result.exit_code, 1) << result.err;
  EXPECT_EQ(json::parse(std::ifstream(file("odd.json"))).size(), 2u);
  const std::vector<char> xml = read_bytes(file("odd.xml"));
  EXPECT_NE(std::string(xml.begin(), xml.end()).find("odd\xef\xbf\xbd&lt;&amp;>.glb"),
            std::string::npos);
}

TEST_F(ValidateCommand, PrintsNamesThatCannotPassForLinesOrCommands) {
  const std::string odd =
      "odd\x1b[2J\xc2\x9b"
      "2J\n0 errors.glb";
  write(file(odd), read_bytes(file("good.glb")));
  const CommandResult there = validate({file(odd)});
  EXPECT_EQ(there.exit_code, 0) << there.err;
  EXPECT_EQ(there.out, file("odd\xef\xbf\xbd[2J\xef\xbf\xbd\xef\xbf\xbd"
                            "2J 0 errors.glb: 0 errors, 0 warnings\n"));
  const CommandResult missing = validate({file(odd + "missing")});
  EXPECT_EQ(missing.exit_code, 2);
  EXPECT_EQ(missing.err.find('\x1b'), std::string::npos);
  EXPECT_EQ(std::count(missing.err.begin(), missing.err.end(), '\n'), 1) << missing.err;
}

TEST_F(ValidateCommand, OverwritesNothingThatItReads) {
  const std::string good = file("good.glb"), report = file("report.txt");
  const std::vector<char> before = read_bytes(good);
  write_off(file("scan.off"), sphere(1));
  std::filesystem::create_symlink(good, file("link.json"));
  for (const char* option : {"-o", "--junit"})
    for (const std::string& target : {good, file("empty/../good.glb"), file("link.json")})
      EXPECT_EQ(validate({good, option, target}).exit_code, 2) << option << " " << target;
  EXPECT_EQ(validate({good, "--source", file("scan.off"), "-o", file("scan.off")}).exit_code, 2);
  EXPECT_EQ(validate({good, "-o", report, "--junit", report}).exit_code, 2);
  EXPECT_FALSE(std::filesystem::exists(report));
  EXPECT_EQ(read_bytes(good), before);
}

TEST_F(ValidateCommand, RefusesEmptyArguments) {
  for (const char* option : {"-o", "--junit", "--max-bytes", "--max-error", "--source"})
    EXPECT_EQ(validate({file("good.glb"), option, ""}).exit_code, 2) << option;
  EXPECT_EQ(validate({file("good.glb"), ""}).exit_code, 2);
}

// Where there is no mesh to measure because of errors, the errors are what to tell.
TEST_F(ValidateCommand, TellsTheErrorsOfAFileThatItCannotMeasure) {
  write_off(file("scan.off"), sphere(1));
  const CommandResult result = validate({file("text.glb"), "--source", file("scan.off")});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_NE(result.out.find("FILE_FORMAT_UNKNOWN"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("SOURCE_NOT_MEASURED"), std::string::npos) << result.out;
}

// One conversion serves what a scan can tell of its file and of others.
TEST_F(ValidateCommand, MeasuresWhatTheTableStates) {
  const std::string scan = file("scan.off"), converted = file("converted.glb");
  write_off(scan, add_bumps(sphere(2), 0.02, 4));
  ASSERT_EQ(
      run_zerotree({"convert", scan, "-o", converted, "--base-vertices", "40", "--levels", "2"})
          .exit_code,
      0);
  const CommandResult same = validate({converted, "--source", scan, "-o", file("measured.json")});
  EXPECT_EQ(same.exit_code, 0) << same.out;
  EXPECT_NE(same.out.find("0 errors, 0 warnings"), std::string::npos) << same.out;
  const json report = json::parse(std::ifstream(file("measured.json")));
  const json& mesh = report["info"]["progressiveMeshes"][0];
  EXPECT_EQ(mesh["measuredPrefixes"].size(), mesh["prefixCount"]);

  write_changed(converted, file("boast.glb"), [](json& root) {
    for (json& entry : table(root))
      entry["geometricError"] = entry["geometricError"].get<double>() / 2;
  });
  EXPECT_EQ(validate({file("boast.glb")}).exit_code, 0);
  const CommandResult boast = validate({file("boast.glb"), "--source", scan});
  EXPECT_EQ(boast.exit_code, 1);
  EXPECT_NE(boast.out.find("PREFIX_ERROR_UNDERSTATED"), std::string::npos) << boast.out;

  write_off(file("other.off"), add_bumps(sphere(2), 0.05, 2));
  const CommandResult other = validate({converted, "--source", file("other.off")});
  EXPECT_EQ(other.exit_code, 1);
  EXPECT_NE(other.out.find("SOURCE_DIAGONAL_MISMATCH"), std::string::npos) << other.out;
  EXPECT_NE(other.out.find("PREFIX_ERROR_UNDERSTATED"), std::string::npos) << other.out;
}

TEST_F(ValidateCommand, MeasuresOneFileAgainstItsScan) {
  const std::string scan = file("one.off");
  write_off(scan, sphere(1));
  EXPECT_EQ(validate({file("good.glb"), file("good.zt"), "--source", scan}).exit_code, 2);
  EXPECT_EQ(validate({file("good.zt"), "--source", scan}).exit_code, 2);
  EXPECT_EQ(validate({file("plain.gltf"), "--source", scan}).exit_code, 2);
  EXPECT_EQ(validate({file("good.glb"), "--source", file("missing.off")}).exit_code, 2);
  EXPECT_EQ(validate({file("good.glb"), "--fill-holes", "0.1"}).exit_code, 2);
}

// The errors of a scan with filled holes are those of the filled one.
TEST_F(ValidateCommand, MeasuresAgainstTheScanAsItWasChanged) {
  TriangleMesh open = add_bumps(sphere(2), 0.02, 4);
  std::erase_if(open.triangles, [&](const Triangle& t) {
    return open.positions[t[0]].z() > 0.9 && open.positions[t[1]].z() > 0.9;
  });
  write_off(file("open.off"), open);
  ASSERT_EQ(run_zerotree({"convert", file("open.off"), "-o", file("filled.glb"), "--fill-holes",
                          "1.0", "--base-vertices", "40", "--levels", "1"})
                .exit_code,
            0);
  EXPECT_EQ(validate({file("filled.glb"), "--source", file("open.off")}).exit_code, 1);
  const CommandResult same =
      validate({file("filled.glb"), "--source", file("open.off"), "--fill-holes", "1.0"});
  EXPECT_EQ(same.exit_code, 0) << same.out;
}

}  // namespace
}  // namespace zerotree::test
