// The command on meshes made in code: outputs, exit codes, determinism, nothing left behind.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "command_runner.h"
#include "shapes.h"

namespace zerotree::test {
namespace {

TriangleMesh bumpy_sphere() {
  return add_bumps(sphere(3), 0.02, 4);
}

double compared_error(const std::string& reference, const std::string& test) {
  const CommandResult result =
      run_zerotree({"compare", reference, test, "--json", "--samples", "100000"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  return nlohmann::json::parse(result.out)["symmetric"]["rms"];
}

std::size_t files_in(const std::filesystem::path& folder) {
  return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder),
                                                std::filesystem::directory_iterator()));
}

// A glTF file of `mesh` with its numbers in a file beside it, and with what tools leave in one: a
// material, a texture, a camera.
void write_furnished_gltf(const ScratchFolder& folder, const TriangleMesh& mesh) {
  std::ofstream numbers(folder / "numbers.bin", std::ios::binary);
  const auto put = [&](auto value) {
    numbers.write(reinterpret_cast<const char*>(&value), sizeof value);
  };
  for (const Eigen::Vector3d& p : mesh.positions)
    for (int k = 0; k < 3; ++k) put(static_cast<float>(p[k]));
  for (const Triangle& t : mesh.triangles)
    for (std::uint32_t v : t) put(v);
  const std::size_t positions = mesh.positions.size(), indices = 3 * mesh.triangles.size();
  using nlohmann::json;
  json gltf = json::parse(R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
    "nodes": [{"children": [1, 2]}, {"mesh": 0}, {"camera": 0}],
    "cameras": [{"type": "perspective", "perspective": {"yfov": 0.6, "znear": 1}}],
    "materials": [{"name": "skin", "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
    "textures": [{"source": 0, "sampler": 0}], "images": [{"uri": "missing.png"}],
    "samplers": [{"magFilter": 9729, "minFilter": 9986, "wrapS": 10497, "wrapT": 10497}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]}]})");
  gltf["buffers"] = {{{"uri", "numbers.bin"}, {"byteLength", 12 * positions + 4 * indices}}};
  gltf["bufferViews"] = {
      {{"buffer", 0}, {"byteLength", 12 * positions}},
      {{"buffer", 0}, {"byteOffset", 12 * positions}, {"byteLength", 4 * indices}}};
  gltf["accessors"] = {
      {{"bufferView", 0}, {"componentType", 5126}, {"count", positions}, {"type", "VEC3"}},
      {{"bufferView", 1}, {"componentType", 5125}, {"count", indices}, {"type", "SCALAR"}}};
  gltf["accessors"][0]["min"] = {-2, -2, -2};
  gltf["accessors"][0]["max"] = {2, 2, 2};
  std::ofstream(folder / "in.gltf") << gltf;
}

TEST(Command, ConvertsAndDecodesEveryOutput) {
  const ScratchFolder folder;
  write_off(folder / "in.off", bumpy_sphere());
  const CommandResult converted =
      run_zerotree({"convert", folder / "in.off", "-o", folder / "out.glb", "--stream",
                    folder / "out.zt", "--report", folder / "report.json"});
  ASSERT_EQ(converted.exit_code, 0) << converted.err;
  EXPECT_EQ(converted.err, "") << "progress belongs to terminals only";
  for (const std::string stream : {"out.glb", "out.zt"})
    for (const std::string mesh : {"a.ply", "a.obj", "a.glb"}) {
      const CommandResult decoded = run_zerotree({"decode", folder / stream, "-o", folder / mesh});
      ASSERT_EQ(decoded.exit_code, 0) << decoded.err;
      EXPECT_LT(compared_error(folder / "in.off", folder / mesh), 5e-4) << stream << ' ' << mesh;
    }
  EXPECT_EQ(run_zerotree({"validate", folder / "out.glb"}).exit_code, 0);
  EXPECT_EQ(run_zerotree({"info", folder / "out.glb"}).exit_code, 0);
  EXPECT_EQ(run_zerotree({"info", folder / "out.zt"}).exit_code, 0);
}

TEST(Command, CompressesTheBase) {
  const ScratchFolder folder;
  write_off(folder / "in.off", bumpy_sphere());
  const auto convert = [&](const std::string& name, const std::vector<std::string>& options) {
    std::vector<std::string> arguments{"convert",     folder / "in.off", "-o",
                                       folder / name, "--base-vertices", "80"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const CommandResult result = run_zerotree(arguments);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return std::filesystem::file_size(folder / name);
  };
  const auto plain = convert("plain.glb", {});
  const auto with_normals = convert("normals.glb", {"--base-normals"});
  EXPECT_GT(with_normals, plain);
  EXPECT_LT(convert("small.glb", {"--compress-base"}), plain);
  EXPECT_LT(convert("both.glb", {"--compress-base", "--base-normals"}), with_normals);
  for (const std::string name : {"normals.glb", "small.glb", "both.glb"}) {
    EXPECT_EQ(run_zerotree({"validate", folder / name}).exit_code, 0) << name;
    EXPECT_EQ(run_zerotree({"info", folder / name}).exit_code, 0) << name;
    for (const std::string& file : {std::string("plain.glb"), name})
      ASSERT_EQ(run_zerotree({"decode", folder / file, "-o", folder / (file + ".ply")}).exit_code,
                0);
    // The decoded surface lies where the scan does, not on the grid; the base opens as a mesh.
    EXPECT_LT(compared_error(folder / "plain.glb.ply", folder / (name + ".ply")), 2e-5) << name;
    EXPECT_LT(compared_error(folder / "plain.glb", folder / name), 2e-5) << name;
  }
  EXPECT_EQ(
      run_zerotree({"decode", folder / "small.glb", "-o", folder / "a.ply", "--error", "50mm"})
          .exit_code,
      0);
}

// Rounding the table's errors must not push the last one beyond what was asked for.
TEST(Command, StatesNoMoreThanTheErrorAskedFor) {
  const ScratchFolder folder;
  write_off(folder / "in.off", bumpy_sphere());
  for (const std::string compress : {"--threads=1", "--compress-base"}) {
    ASSERT_EQ(run_zerotree({"convert", folder / "in.off", "-o", folder / "a.gltf", "--split",
                            "--max-error", "2e-3", compress})
                  .exit_code,
              0);
    const auto text = read_bytes(folder / "a.gltf");
    const nlohmann::json gltf = nlohmann::json::parse(text.begin(), text.end());
    const nlohmann::json& extension = gltf["meshes"][0]["extensions"]["ZEROTREE_mesh_progressive"];
    const double error = extension["prefixes"].back()["geometricError"];
    EXPECT_LE(error / extension["sourceDiagonal"].get<double>(), 2e-3 * (1 + 1e-6));
    EXPECT_EQ(run_zerotree({"validate", folder / "a.gltf", "--max-error", "2e-3"}).exit_code, 0);
  }
}

TEST(Command, ReportTellsWhatTheFilesHold) {
  const ScratchFolder folder;
  write_off(folder / "in.off", bumpy_sphere());
  ASSERT_EQ(run_zerotree({"convert", folder / "in.off", "-o", folder / "out.glb", "--stream",
                          folder / "out.zt", "--report", folder / "report.json"})
                .exit_code,
            0);
  const auto text = read_bytes(folder / "report.json");
  const nlohmann::json report = nlohmann::json::parse(text.begin(), text.end());
  EXPECT_EQ(report["input"]["vertices"], 642);
  EXPECT_EQ(report["input"]["faces"], 1280);
  EXPECT_EQ(report["stream"]["bytes"], std::filesystem::file_size(folder / "out.zt"));
  EXPECT_EQ(report["file"]["bytes"], std::filesystem::file_size(folder / "out.glb"));
  const nlohmann::json last = report["stream"]["prefixes"].back();
  ASSERT_EQ(run_zerotree({"decode", folder / "out.zt", "-o", folder / "a.ply"}).exit_code, 0);
  const double measured = compared_error(folder / "in.off", folder / "a.ply");
  EXPECT_NEAR(measured, last["error"], 0.02 * measured);
}

TEST(Command, ErrorFallsOverGrowingPrefixes) {
  const ScratchFolder folder;
  write_off(folder / "in.off", bumpy_sphere());
  ASSERT_EQ(run_zerotree({"convert", folder / "in.off", "--stream", folder / "out.zt"}).exit_code,
            0);
  double before = 1;
  for (int bytes = 160; bytes <= 5120; bytes *= 2) {
    ASSERT_EQ(run_zerotree({"decode", folder / "out.zt", "--bytes", std::to_string(bytes), "-o",
                            folder / "a.ply"})
                  .exit_code,
              0);
    const double error = compared_error(folder / "in.off", folder / "a.ply");
    EXPECT_LT(error, 1.1 * before) << bytes;
    before = error;
  }
  EXPECT_LT(before, 2e-3);
}

TEST(Command, SameBytesTwiceAndForAnyNumberOfThreads) {
  const ScratchFolder folder;
  write_off(folder / "in.off", bumpy_sphere());
  for (const std::string run : {"1", "2", "1"}) {
    const std::string name =
        folder / ("t" + run + (std::filesystem::exists(folder / "t1.zt") ? "b" : ""));
    ASSERT_EQ(run_zerotree({"convert", folder / "in.off", "-o", name + ".glb", "--stream",
                            name + ".zt", "--threads", run})
                  .exit_code,
              0);
  }
  for (const std::string extension : {".glb", ".zt"}) {
    EXPECT_EQ(read_bytes(folder / ("t1" + extension)), read_bytes(folder / ("t2b" + extension)));
    EXPECT_EQ(read_bytes(folder / ("t1" + extension)), read_bytes(folder / ("t1b" + extension)));
  }
}

TEST(Command, SplitPutsThePayloadInItsOwnFile) {
  const ScratchFolder folder;
  write_off(folder / "in.off", bumpy_sphere());
  ASSERT_EQ(
      run_zerotree({"convert", folder / "in.off", "-o", folder / "out.gltf", "--split"}).exit_code,
      0);
  EXPECT_TRUE(std::filesystem::exists(folder / "out.zt.bin"));
  ASSERT_EQ(run_zerotree({"decode", folder / "out.gltf", "-o", folder / "a.ply"}).exit_code, 0);
  EXPECT_LT(compared_error(folder / "in.off", folder / "a.ply"), 5e-4);
}

TEST(Command, MeetsTargetsOrSaysThatItCannot) {
  const ScratchFolder folder;
  write_off(folder / "in.off", bumpy_sphere());
  ASSERT_EQ(run_zerotree({"convert", folder / "in.off", "--stream", folder / "out.zt",
                          "--max-error", "1e-3"})
                .exit_code,
            0);
  ASSERT_EQ(run_zerotree({"decode", folder / "out.zt", "-o", folder / "a.ply"}).exit_code, 0);
  EXPECT_LE(compared_error(folder / "in.off", folder / "a.ply"), 1.02e-3);
  ASSERT_EQ(run_zerotree({"convert", folder / "in.off", "-o", folder / "small.glb", "--target-size",
                          "10000"})
                .exit_code,
            0);
  EXPECT_LE(std::filesystem::file_size(folder / "small.glb"), 10000u);
  EXPECT_EQ(run_zerotree({"convert", folder / "in.off", "--stream", folder / "no.zt", "--max-error",
                          "1e-12"})
                .exit_code,
            5);
  EXPECT_EQ(
      run_zerotree({"convert", folder / "in.off", "-o", folder / "no.glb", "--target-size", "100"})
          .exit_code,
      5);
  EXPECT_EQ(run_zerotree({"convert", folder / "in.off", "--stream", folder / "no.zt",
                          "--memory-limit", "1MiB"})
                .exit_code,
            6);
  EXPECT_FALSE(std::filesystem::exists(folder / "no.zt"));
  EXPECT_FALSE(std::filesystem::exists(folder / "no.glb"));
}

TEST(Command, FillsTheSizeAskedForAndNeverMore) {
  const ScratchFolder folder;
  write_off(folder / "in.off", bumpy_sphere());
  for (const std::string form : {"a.glb", "b.gltf", "c.zt"}) {
    for (const std::uint64_t size :
         form == "a.glb" ? std::vector{4000u, 9000u} : std::vector{9000u}) {
      std::filesystem::create_directory(folder / "out");
      const std::string output = folder.path / "out" / form, number = std::to_string(size);
      const CommandResult result =
          form == "c.zt" ? run_zerotree({"convert", folder / "in.off", "--stream", output,
                                         "--target-size", number})
          : form == "a.glb"
              ? run_zerotree({"convert", folder / "in.off", "-o", output, "--target-size", number})
              : run_zerotree({"convert", folder / "in.off", "-o", output, "--split",
                              "--target-size", number});
      ASSERT_EQ(result.exit_code, 0) << result.err;
      std::uint64_t written = 0;
      for (const auto& file : std::filesystem::directory_iterator(folder / "out"))
        written += file.file_size();
      EXPECT_LE(written, size) << form;
      EXPECT_GE(written, 0.98 * static_cast<double>(size)) << form;
      EXPECT_NE(result.out.find("used " + std::to_string(written)), std::string::npos)
          << result.out;
      std::filesystem::remove_all(folder / "out");
    }
  }
}

TEST(Command, RefusesOutputsAndSizesThatMeanNothing) {
  const ScratchFolder folder;
  write_off(folder / "in.off", bumpy_sphere());
  std::filesystem::create_directory(folder / "folder.glb");
  const auto code = [&](std::vector<std::string> options) {
    std::vector<std::string> arguments{"convert", folder / "in.off"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return run_zerotree(arguments).exit_code;
  };
  EXPECT_EQ(code({"-o", folder / "a.glb", "--target-size", "0"}), 2);
  EXPECT_EQ(code({"-o", folder / "a.glb", "--memory-limit", "0"}), 2);
  EXPECT_EQ(code({"-o", folder / "folder.glb", "--stream", folder / "a.zt"}), 2);
  EXPECT_EQ(code({"-o", folder / "a.glb", "--stream", folder / "./a.glb"}), 2);
  EXPECT_FALSE(std::filesystem::exists(folder / "a.glb"));
  EXPECT_FALSE(std::filesystem::exists(folder / "a.zt"));
}

TEST(Command, NamesTheErrorThatCanBeReached) {
  const ScratchFolder folder;
  write_off(folder / "in.off", bumpy_sphere());
  const CommandResult error = run_zerotree(
      {"convert", folder / "in.off", "--stream", folder / "x.zt", "--max-error", "1e-9"});
  EXPECT_EQ(error.exit_code, 5);
  EXPECT_NE(error.err.find("the whole stream has "), std::string::npos) << error.err;
  const CommandResult both =
      run_zerotree({"convert", folder / "in.off", "--stream", folder / "x.zt", "--max-error",
                    "5e-4", "--target-size", "200"});
  EXPECT_EQ(both.exit_code, 5);
  EXPECT_NE(both.err.find("--target-size allows 200"), std::string::npos) << both.err;
  EXPECT_EQ(files_in(folder.path), 1u);
}

TEST(Command, MakesTheTransformAskedFor) {
  const ScratchFolder folder;
  write_off(folder / "in.off", bumpy_sphere());
  for (const std::string transform : {"local", "mirror", "auto"}) {
    ASSERT_EQ(run_zerotree({"convert", folder / "in.off", "--stream", folder / "x.zt",
                            "--transform", transform, "--report", folder / "r.json"})
                  .exit_code,
              0);
    const nlohmann::json report = nlohmann::json::parse(std::ifstream(folder / "r.json"));
    const std::string made = report["transform"]["name"];
    if (transform != "auto") {
      EXPECT_EQ(made, transform);
    }
    EXPECT_EQ(report["transform"].contains("meanErrors"), transform == "auto");
    const CommandResult info = run_zerotree({"info", folder / "x.zt"});
    EXPECT_NE(info.out.find("transform      " + made), std::string::npos) << info.out;
    ASSERT_EQ(run_zerotree({"decode", folder / "x.zt", "-o", folder / "a.ply"}).exit_code, 0);
    EXPECT_LT(compared_error(folder / "in.off", folder / "a.ply"), 5e-4) << transform;
  }
  EXPECT_EQ(run_zerotree({"convert", folder / "in.off", "--stream", folder / "x.zt", "--transform",
                          "fourier"})
                .exit_code,
            2);
}

TEST(Command, RefusesWithTheRightCodeASentenceAndNoOutput) {
  const ScratchFolder folder;
  std::ofstream(folder / "empty.off");
  std::ofstream(folder / "nan.off") << "OFF\n3 1 0\n0 0 0\n1 nan 0\n0 1 0\n3 0 1 2\n";
  std::ofstream(folder / "range.off") << "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n";
  // A Moebius strip of five quads.
  std::ofstream moebius(folder / "moebius.obj");
  for (int i = 0; i < 5; ++i)
    moebius << "v " << i << " 0 " << i % 2 << "\nv " << i << " 1 " << i % 2 << "\n";
  for (int i = 0; i < 4; ++i)
    moebius << "f " << 2 * i + 1 << ' ' << 2 * i + 3 << ' ' << 2 * i + 4 << ' ' << 2 * i + 2
            << "\n";
  moebius << "f 9 2 1 10\n";
  moebius.close();
  const std::size_t files = files_in(folder.path);
  const std::pair<std::string, int> cases[] = {
      {"missing.off", 3}, {"empty.off", 3}, {"nan.off", 3}, {"range.off", 3}, {"moebius.obj", 4}};
  for (const auto& [file, code] : cases) {
    const CommandResult result =
        run_zerotree({"convert", folder / file, "-o", folder / "x.glb", "--stream", folder / "x.zt",
                      "--report", folder / "x.json"});
    EXPECT_EQ(result.exit_code, code) << file << ": " << result.err;
    EXPECT_TRUE(result.err.starts_with("zerotree: ")) << result.err;
    EXPECT_GT(result.err.size(), 30u);
    EXPECT_EQ(files_in(folder.path), files) << file;
  }
  EXPECT_EQ(run_zerotree({"convert"}).exit_code, 2);
  EXPECT_EQ(run_zerotree({"convert", folder / "nan.off"}).exit_code, 2);
  EXPECT_EQ(run_zerotree({"frobnicate"}).exit_code, 2);
  EXPECT_EQ(run_zerotree({"--help"}).exit_code, 0);
  EXPECT_EQ(run_zerotree({"validate", folder / "missing.glb"}).exit_code, 2);
}

// The command links two libraries that know glTF; a part of the one must not serve the other.
TEST(Command, FillsHolesAndRemovesHandlesOnRequestOnly) {
  const ScratchFolder folder;
  TriangleMesh ring = midpoint_subdivide(
      voxel_surface(
          {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {2, 1, 0}, {0, 2, 0}, {1, 2, 0}, {2, 2, 0}}),
      2);
  ring.triangles.pop_back();
  write_off(folder / "in.off", ring);
  const auto convert = [&](std::vector<std::string> more) {
    std::vector<std::string> arguments{"convert",  folder / "in.off",
                                       "--stream", folder / "out.zt",
                                       "--report", folder / "report.json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const CommandResult result = run_zerotree(arguments);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return nlohmann::json::parse(std::ifstream(folder / "report.json"));
  };
  const nlohmann::json kept = convert({});
  EXPECT_EQ(kept["clean"]["boundaryLoops"], 1);
  EXPECT_EQ(kept["clean"]["genus"], 1);
  EXPECT_EQ(kept["holes"]["filled"], 0);
  EXPECT_GT(kept["remesh"]["levels"], 0);
  const nlohmann::json changed = convert({"--fill-holes", "0.5", "--remove-handles", "4.5m"});
  EXPECT_EQ(changed["clean"]["boundaryLoops"], 0);
  EXPECT_EQ(changed["clean"]["genus"], 0);
  EXPECT_EQ(changed["holes"]["filled"], 1);
  EXPECT_EQ(changed["holes"]["leftRims"].size(), 0u);
  EXPECT_EQ(changed["handles"]["removed"], 1);
  EXPECT_EQ(changed["handles"]["genusBefore"], 1);
  for (const char* option : {"--fill-holes", "--remove-handles"}) {
    const CommandResult refused =
        run_zerotree({"convert", folder / "in.off", "--stream", folder / "x.zt", option, "small"});
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_NE(refused.err.find(option), std::string::npos) << refused.err;
  }
}

TEST(Command, ReadsAGltfWithMaterialsAndCameras) {
  const ScratchFolder folder;
  const TriangleMesh mesh = bumpy_sphere();
  write_furnished_gltf(folder, mesh);
  write_off(folder / "same.off", mesh);
  const CommandResult converted = run_zerotree(
      {"convert", folder / "in.gltf", "--stream", folder / "x.zt", "--report", folder / "r.json"});
  ASSERT_EQ(converted.exit_code, 0) << converted.err;
  for (const std::string lost : {"Cameras", "Materials", "Textures"})
    EXPECT_NE(converted.out.find(lost + " are not carried"), std::string::npos) << converted.out;
  ASSERT_EQ(run_zerotree({"decode", folder / "x.zt", "-o", folder / "a.ply"}).exit_code, 0);
  EXPECT_LT(compared_error(folder / "same.off", folder / "a.ply"), 5e-4);
}

TEST(Command, NeverTouchesTheInput) {
  const ScratchFolder folder;
  write_off(folder / "in.off", bumpy_sphere());
  const std::vector<char> before = read_bytes(folder / "in.off");
  EXPECT_EQ(run_zerotree({"convert", folder / "in.off", "--stream", folder / "in.off"}).exit_code,
            2);
  EXPECT_EQ(read_bytes(folder / "in.off"), before);
}

}  // namespace
}  // namespace zerotree::test
