#include <cstdio>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "cli/commands.h"
#include "cli/quantities.h"
#include "cli/terminal_progress.h"
#include "convert/convert.h"
#include "export/atomic_file.h"
#include "mesh/error.h"

namespace zerotree::cli {
namespace {

struct ConvertArguments {
  convert::ConvertOptions options;
  std::filesystem::path report;
  std::string max_error;
  std::string fill_holes;
  std::string remove_handles;
};

void print_targets(const char* what, const report::ReachedTargets& targets) {
  if (targets.max_error > 0)
    std::printf("  %s: asked for an error of %.4g, reached %.4g with %llu bytes\n", what,
                targets.max_error, targets.reached_error,
                static_cast<unsigned long long>(targets.reached_size));
  if (targets.size > 0)
    std::printf("  %s: allowed %llu bytes, used %llu with an error of %.4g\n", what,
                static_cast<unsigned long long>(targets.size),
                static_cast<unsigned long long>(targets.reached_size), targets.reached_error);
  if (targets.size > 0 && targets.max_error == 0 && targets.is_whole_stream)
    std::printf(
        "  %s: that is all there is, with the finest step that makes sense or fits the format\n",
        what);
}

void print_summary(const ConvertArguments& arguments, const report::ConvertReport& report) {
  std::printf("%s: %llu vertices, %llu faces -> base of %llu vertices, %d levels\n",
              report.input.c_str(), static_cast<unsigned long long>(report.input_vertices),
              static_cast<unsigned long long>(report.input_faces),
              static_cast<unsigned long long>(report.base_vertices), report.levels);
  for (const report::Repair& repair : report.repairs)
    std::printf("  repaired: %s: %llu\n", repair.what.c_str(),
                static_cast<unsigned long long>(repair.count));
  if (!arguments.fill_holes.empty())
    std::printf("  holes filled: %zu, boundary loops left: %zu\n", report.filled_rims.size(),
                report.left_rims.size());
  if (!arguments.remove_handles.empty())
    std::printf("  handles removed: %zu, genus left: %lld\n", report.handle_loops.size(),
                static_cast<long long>(report.genus));
  for (const std::string& lost : report.not_carried)
    std::printf("  not carried: %s\n", lost.c_str());
  std::printf(
      "  remesh error %.2f, discretisation error of the input %.2f (1e-5 of the diagonal)\n",
      report.remeshing_error * 1e5, report.discretisation_error * 1e5);
  if (report.transform_errors.local > 0)
    std::printf("  transform %s: mean error local %.4g, mirror %.4g\n", report.transform.c_str(),
                report.transform_errors.local, report.transform_errors.mirror);
  if (!report.transform_note.empty())
    std::printf("  transform %s: %s\n", report.transform.c_str(), report.transform_note.c_str());
  if (!report.remesh_remark.empty()) std::printf("  note: %s\n", report.remesh_remark.c_str());
  if (report.stream_bytes > 0) print_targets("stream", report.stream_targets);
  if (report.payload_bytes > 0) print_targets("glTF file", report.payload_targets);
  const auto& prefixes =
      arguments.options.glb.empty() ? report.stream_prefixes : report.payload_prefixes;
  std::printf("  %12s  %10s  %s\n", "bytes", "bits/vert", "error (1e-4 of the diagonal)");
  for (const report::PrefixError& prefix : prefixes)
    std::printf("  %12llu  %10.3f  %.3f\n", static_cast<unsigned long long>(prefix.bytes),
                prefix.bits_per_vertex, prefix.error * 1e4);
}

int run_convert(ConvertArguments& arguments) {
  convert::ConvertOptions& options = arguments.options;
  if (!arguments.max_error.empty()) {
    const Distance target = parse_distance(arguments.max_error, "--max-error");
    (target.in_metres ? options.max_error_metres : options.max_error) = target.value;
  }
  if (!arguments.fill_holes.empty()) {
    const Distance size = parse_distance(arguments.fill_holes, "--fill-holes");
    (size.in_metres ? options.fill_holes_metres : options.fill_holes) = size.value;
  }
  if (!arguments.remove_handles.empty()) {
    const Distance size = parse_distance(arguments.remove_handles, "--remove-handles");
    (size.in_metres ? options.remove_handles_metres : options.remove_handles) = size.value;
  }
  report::ConvertReport report;
  {
    TerminalProgress progress;
    report = convert::convert_file(options, progress.callback());
  }
  if (!arguments.report.empty())
    exporter::write_file_atomically(arguments.report, report::to_json(report).dump(2) + "\n");
  print_summary(arguments, report);
  return static_cast<int>(ExitCode::done);
}

}  // namespace

void add_convert(CLI::App& app, int& exit_code) {
  auto arguments = std::make_shared<ConvertArguments>();
  convert::ConvertOptions& options = arguments->options;
  CLI::App* command = app.add_subcommand("convert", "Turn a scan into a progressive glTF file");
  command
      ->add_option("input", options.input,
                   "Scan: .ply[.gz] .obj .off .stl .glb .gltf .drc; it is never changed")
      ->required();
  command->add_option("-o,--output", options.glb,
                      "Progressive glTF file (.glb, .gltf with --split)");
  command->add_option("--stream", options.stream, "Elementary stream with the base inside (.zt)");
  command->add_option("--report", arguments->report, "JSON report of all figures");
  command->add_flag("--split", options.split, "Payload in a file of its own, NAME.zt.bin");
  command->add_flag("--compress-base", options.compress_base,
                    "Smaller base mesh, for viewers that know KHR_mesh_quantization and "
                    "EXT_meshopt_compression");
  command->add_flag("--base-normals", options.base_normals,
                    "Normals for the base mesh: smooth shading in viewers that show only that");
  command->add_option("--base-vertices", options.base_vertices, "Vertices of the base mesh [auto]")
      ->check(CLI::Range(4, 1000000));
  command->add_option("--levels", options.levels, "Subdivision levels [auto]")
      ->check(CLI::Range(0, 10));
  command
      ->add_option("--crease-angle", options.crease_angle_degrees,
                   "Edges bent by more degrees than this are creases; 180: none [auto]")
      ->check(CLI::Range(1.0, 180.0));
  command->add_option("--fill-holes", arguments->fill_holes,
                      "Fill boundary loops whose bounding box has a shorter diagonal: 0.05, 3mm");
  command->add_option(
      "--remove-handles", arguments->remove_handles,
      "Cut handles and tunnels with a closed path shorter than this around them: 0.02, 3mm");
  command->add_option("--max-error", arguments->max_error,
                      "The shortest stream whose measured error is at most this: 1e-4, 0.5mm");
  command
      ->add_option("--target-size", options.target_size,
                   "The best output of at most this size, for each of -o (with --split: its "
                   "files together) and --stream: 200000, 200kB")
      ->transform(CLI::AsSizeValue(true))
      ->check(CLI::PositiveNumber);
  const std::map<std::string, convert::TransformChoice> transforms{
      {"auto", convert::TransformChoice::automatic},
      {"local", convert::TransformChoice::local},
      {"mirror", convert::TransformChoice::mirror}};
  command
      ->add_option("--transform", options.transform,
                   "Wavelets: local, mirror (slower), auto: the better one by measured error "
                   "[local]")
      ->transform(CLI::CheckedTransformer(transforms))
      ->type_name("auto|local|mirror");
  command->add_option("--threads", options.threads, "Threads [one per core]")
      ->check(CLI::Range(1, 1024));
  command->add_option("--memory-limit", options.memory_limit, "Most memory to use: 4GiB")
      ->transform(CLI::AsSizeValue(true))
      ->check(CLI::PositiveNumber);
  command->add_option("--debug-pictures", options.debug_pictures,
                      "Folder for pictures of base, parameter lines, error and details (PNG)");
  command->callback([arguments, &exit_code] { exit_code = run_convert(*arguments); });
}

}  // namespace zerotree::cli
