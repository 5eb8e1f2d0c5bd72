#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "cli/terminal_progress.h"
#include "import/import_mesh.h"
#include "measure/surface_distance.h"

namespace zerotree::cli {
namespace {

struct CompareArguments {
  std::filesystem::path reference, test;
  bool json = false;
  measure::DistanceOptions distance;
};

nlohmann::ordered_json direction_json(const measure::DirectedDistance& distance, double diagonal) {
  return {{"rms", distance.rms / diagonal},
          {"mean", distance.mean / diagonal},
          {"max", distance.maximum / diagonal},
          {"normalMeanDegrees", distance.normal_mean_degrees},
          {"normalMaxDegrees", distance.normal_max_degrees}};
}

void print_json(const CompareArguments& arguments, const measure::SurfaceDistance& distance) {
  const nlohmann::ordered_json report = {
      {"reference", arguments.reference.string()},
      {"test", arguments.test.string()},
      {"samples", arguments.distance.samples},
      {"diagonal", distance.diagonal},
      {"symmetric", direction_json(distance.symmetric, distance.diagonal)},
      {"fromReference", direction_json(distance.from_reference, distance.diagonal)},
      {"fromTest", direction_json(distance.from_test, distance.diagonal)}};
  std::puts(report.dump(2).c_str());
}

void print_row(const char* name, const measure::DirectedDistance& distance, double diagonal) {
  std::printf("%-20s  %12.6g  %12.6g  %12.6g  %10.3f  %10.3f\n", name, distance.rms / diagonal,
              distance.mean / diagonal, distance.maximum / diagonal, distance.normal_mean_degrees,
              distance.normal_max_degrees);
}

void print_table(const measure::SurfaceDistance& distance) {
  std::printf("distances relative to the reference's diagonal of %.9g; angles in degrees\n",
              distance.diagonal);
  std::printf("%-20s  %12s  %12s  %12s  %10s  %10s\n", "", "RMS", "mean", "max", "angle mean",
              "angle max");
  print_row("reference to test", distance.from_reference, distance.diagonal);
  print_row("test to reference", distance.from_test, distance.diagonal);
  print_row("symmetric (larger)", distance.symmetric, distance.diagonal);
}

TriangleMesh read_surface(const std::filesystem::path& path, const Progress& progress) {
  return importer::import_mesh(path, {}, progress).mesh;
}

void run_compare(const CompareArguments& arguments) {
  measure::SurfaceDistance distance;
  {
    TerminalProgress progress;
    const TriangleMesh reference = read_surface(arguments.reference, progress.callback());
    const TriangleMesh test = read_surface(arguments.test, progress.callback());
    distance = measure::compare_surfaces(reference, test, arguments.distance);
  }
  if (arguments.json)
    print_json(arguments, distance);
  else
    print_table(distance);
}

}  // namespace

void add_compare(CLI::App& app, int& exit_code) {
  auto arguments = std::make_shared<CompareArguments>();
  CLI::App* command = app.add_subcommand("compare", "Measure how far two surfaces lie apart");
  command->add_option("reference", arguments->reference, "The original mesh")->required();
  command->add_option("test", arguments->test, "The mesh to judge")->required();
  command->add_flag("--json", arguments->json, "Print JSON instead of a table");
  command->add_option("--samples", arguments->distance.samples, "Samples each way [1000000]")
      ->check(CLI::Range(1000, 1000000000));
  command->add_option("--threads", arguments->distance.threads, "Threads [one per core]")
      ->check(CLI::Range(1, 1024));
  command->callback([arguments, &exit_code] {
    run_compare(*arguments);
    exit_code = 0;
  });
}

}  // namespace zerotree::cli
