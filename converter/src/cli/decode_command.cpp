#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "cli/commands.h"
#include "cli/quantities.h"
#include "decode/prefix_surface.h"
#include "decode/stream_file.h"
#include "export/atomic_file.h"
#include "export/mesh_bytes.h"
#include "mesh/error.h"

namespace zerotree::cli {
namespace {

struct DecodeArguments {
  std::filesystem::path input, output;
  std::optional<std::uint64_t> bytes;
  std::string error;
  std::optional<int> level;
  bool balanced = false;
};

// The shortest prefix of the file's own table whose error is at most `target`.
std::uint64_t bytes_for_error(const decode::StreamFile& file, const Distance& target) {
  if (file.prefixes.empty())
    throw Error(ExitCode::usage,
                "--error needs the table of measured errors that only the glTF file carries: "
                "decode that, or say --bytes");
  const double wanted = target.relative_to(file.source_diagonal);
  const auto entry =
      std::find_if(file.prefixes.begin(), file.prefixes.end(),
                   [&](const decode::MeasuredPrefix& prefix) { return prefix.error <= wanted; });
  if (entry == file.prefixes.end())
    throw Error(ExitCode::target_not_reachable,
                "the whole stream has an error of " + std::to_string(file.prefixes.back().error) +
                    ", more than asked for: convert again with a finer remesh (--levels)");
  return entry->bytes;
}

void run_decode(const DecodeArguments& arguments) {
  const decode::StreamFile file = decode::open_stream_file(arguments.input);
  std::uint64_t bytes = arguments.bytes.value_or(file.bytes.size());
  if (!arguments.error.empty())
    bytes = bytes_for_error(file, parse_distance(arguments.error, "--error"));
  decode::PrefixSurface prefix(file);
  prefix.advance_to(bytes);
  const exporter::Surface surface =
      prefix.surface(arguments.level, arguments.balanced ? surface::kBalanced : 0.0f);
  exporter::write_file_atomically(
      arguments.output, exporter::mesh_bytes(surface, arguments.output.extension().string()));
  std::printf("%s: %llu of %llu bytes -> %zu vertices, %zu triangles\n",
              arguments.output.string().c_str(),
              static_cast<unsigned long long>(std::min<std::uint64_t>(bytes, file.bytes.size())),
              static_cast<unsigned long long>(file.bytes.size()), surface.positions.size(),
              surface.triangles.size());
}

}  // namespace

void add_decode(CLI::App& app, int& exit_code) {
  auto arguments = std::make_shared<DecodeArguments>();
  CLI::App* command = app.add_subcommand("decode", "Turn any prefix of a stream into a mesh");
  command->add_option("input", arguments->input, "Progressive .glb/.gltf or elementary .zt")
      ->required();
  command->add_option("-o,--output", arguments->output, "Mesh to write: .ply, .obj or .glb")
      ->required();
  CLI::Option* bytes =
      command->add_option("--bytes", arguments->bytes,
                          "Use the first N bytes: of the .zt file, or of the glTF payload [all]");
  command->add_option("--error", arguments->error, "Use the shortest prefix of at most this error")
      ->excludes(bytes);
  command->add_option("--level", arguments->level, "Sampling density of the output [auto]");
  command->add_flag("--balanced", arguments->balanced,
                    "Vertices a little off the smooth surface, so that its triangles are as much "
                    "outside as inside: a third less error at coarse levels");
  command->callback([arguments, &exit_code] {
    run_decode(*arguments);
    exit_code = 0;
  });
}

}  // namespace zerotree::cli
