#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <limits>
#include <memory>
#include <new>
#include <nlohmann/json.hpp>
#include <string>
#include <system_error>
#include <vector>

#include "cli/commands.h"
#include "cli/quantities.h"
#include "cli/scan_file.h"
#include "cli/terminal_progress.h"
#include "export/atomic_file.h"
#include "measure/surface_index.h"
#include "mesh/error.h"
#include "validate/file_validation.h"
#include "validate/input_files.h"
#include "validate/junit_report.h"
#include "validate/printable_text.h"
#include "validate/validation_report.h"

namespace zerotree::cli {
namespace {

using gltf::Severity;
using validate::InputFile;
using validate::ValidationReport;

// Exit codes of `validate` (README).
constexpr int kErrorsFound = 1, kCouldNotRun = 2;

struct ValidateArguments {
  std::vector<std::filesystem::path> inputs;
  std::filesystem::path report, junit;
  bool is_quiet = false;
  validate::ValidateOptions options;
  std::string max_error;
  std::filesystem::path source;
  RequestedRepairs repairs;
};

// The scan and its search tree, which refers to it.
struct Source {
  Scan scan;
  validate::SourceScan measured;

  explicit Source(Scan read)
      : scan(std::move(read)), measured{measure::SurfaceIndex(scan.mesh), scan.diagonal} {}
};

std::string counts_of(std::size_t errors, std::size_t warnings) {
  return std::to_string(errors) + (errors == 1 ? " error, " : " errors, ") +
         std::to_string(warnings) + (warnings == 1 ? " warning" : " warnings");
}

void print_report(const ValidationReport& report, bool is_quiet) {
  const std::string uri = validate::printable_line(report.uri);
  for (const gltf::Issue& issue : report.issues) {
    if (report.is_unreadable || (is_quiet && !gltf::is_error(issue))) continue;
    std::printf("%s: %s\n", uri.c_str(), validate::issue_line(issue).c_str());
  }
  if (is_quiet) return;
  std::printf("%s: %s\n", uri.c_str(),
              report.is_unreadable ? "could not be read"
                                   : counts_of(count_issues(report, Severity::error),
                                               count_issues(report, Severity::warning))
                                         .c_str());
}

void print_totals(const std::vector<ValidationReport>& reports) {
  std::size_t errors = 0, warnings = 0, unreadable = 0;
  for (const ValidationReport& report : reports) {
    unreadable += report.is_unreadable ? 1 : 0;
    errors += report.is_unreadable ? 0 : count_issues(report, Severity::error);
    warnings += count_issues(report, Severity::warning);
  }
  std::printf("%zu %s: %s", reports.size(), reports.size() == 1 ? "file" : "files",
              counts_of(errors, warnings).c_str());
  if (unreadable > 0) std::printf(", %zu could not be read", unreadable);
  std::printf("\n");
}

void print_problem(const std::string& problem) {
  std::fprintf(stderr, "zerotree: %s\n", validate::printable_line(problem).c_str());
}

// Whatever happens to one file, the others are checked.
ValidationReport validate_input(const InputFile& input, const validate::ValidateOptions& options) {
  std::string problem = input.problem.empty() ? "" : input.path.string() + ": " + input.problem;
  if (problem.empty()) {
    try {
      TerminalProgress progress;
      return validate::validate_file(input.path, options, progress.callback());
    } catch (const Error& error) {
      if (error.code() == ExitCode::usage) throw;
      problem = error.what();
    } catch (const std::bad_alloc&) {
      problem = input.path.string() + ": out of memory: lower --max-vertices";
    } catch (const std::exception& error) {
      problem = input.path.string() + ": internal error: " + error.what();
    }
  }
  print_problem(problem);
  return validate::unreadable_report(input.path, problem);
}

bool are_same_file(const std::filesystem::path& a, const std::filesystem::path& b) {
  std::error_code ignored;  // what cannot be looked at is told apart by its name
  return std::filesystem::equivalent(a, b, ignored) ||
         std::filesystem::weakly_canonical(a, ignored) ==
             std::filesystem::weakly_canonical(b, ignored);
}

// A report must not take the place of a file that is read, nor of the other report.
void check_outputs(const ValidateArguments& arguments, const std::vector<InputFile>& inputs) {
  const auto keep_apart = [](const std::filesystem::path& report,
                             const std::filesystem::path& other) {
    if (!report.empty() && !other.empty() && are_same_file(report, other))
      throw Error(ExitCode::usage,
                  report.string() + ": would be overwritten: name another file for the report");
  };
  keep_apart(arguments.junit, arguments.report);
  for (const std::filesystem::path& report : {arguments.report, arguments.junit}) {
    keep_apart(report, arguments.source);
    for (const InputFile& input : inputs) keep_apart(report, input.path);
  }
}

void write_reports(const ValidateArguments& arguments, const std::vector<ValidationReport>& reports,
                   bool is_list) {
  if (!arguments.report.empty()) {
    nlohmann::ordered_json json = nlohmann::ordered_json::array();
    for (const ValidationReport& report : reports) json.push_back(to_json(report));
    const nlohmann::ordered_json& root = is_list ? json : json.at(0);
    exporter::write_file_atomically(
        arguments.report,
        root.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
  }
  if (!arguments.junit.empty())
    exporter::write_file_atomically(arguments.junit, validate::junit_xml(reports));
}

int exit_code_of(const std::vector<ValidationReport>& reports) {
  int code = 0;
  for (const ValidationReport& report : reports) {
    if (report.is_unreadable) return kCouldNotRun;
    if (gltf::first_error(report.issues) != nullptr) code = kErrorsFound;
  }
  return code;
}

int validate_all(ValidateArguments& arguments) {
  validate::ValidateOptions& options = arguments.options;
  if (!arguments.max_error.empty()) {
    const Distance allowed = parse_distance(arguments.max_error, "--max-error");
    (allowed.in_metres ? options.budgets.max_error_metres : options.budgets.max_error) =
        allowed.value;
  }
  const std::vector<InputFile> inputs = validate::find_input_files(arguments.inputs);
  check_outputs(arguments, inputs);
  std::unique_ptr<const Source> source;
  if (!arguments.source.empty()) {
    if (inputs.size() != 1)
      throw Error(ExitCode::usage, "--source: " + std::to_string(inputs.size()) +
                                       " files are named: measure one at a time");
    TerminalProgress progress;
    source = std::make_unique<const Source>(
        read_scan(arguments.source, arguments.repairs, progress.callback()));
    options.source = &source->measured;
  }
  std::vector<ValidationReport> reports;
  for (const InputFile& input : inputs) {
    reports.push_back(validate_input(input, options));
    print_report(reports.back(), arguments.is_quiet);
  }
  std::error_code ignored;  // what cannot be looked at is no folder
  const bool is_list =
      reports.size() != 1 || std::filesystem::is_directory(arguments.inputs.front(), ignored);
  if (is_list && !arguments.is_quiet) print_totals(reports);
  write_reports(arguments, reports, is_list);
  return exit_code_of(reports);
}

int run_validate(ValidateArguments& arguments) {
  try {
    return validate_all(arguments);
  } catch (const std::exception& error) {
    // The codes of the other subcommands mean other things here.
    print_problem(error.what());
    return kCouldNotRun;
  }
}

// An unset variable of a script must not switch a check off.
const CLI::Validator kNotEmpty([](std::string& text) { return text.empty() ? "is empty" : ""; },
                               "");
const CLI::Range kPositive(std::uint64_t{1}, std::numeric_limits<std::uint64_t>::max(), "POSITIVE");

void add_budgets(CLI::App& command, ValidateArguments& arguments) {
  validate::Budgets& budgets = arguments.options.budgets;
  command
      .add_option("--max-bytes", budgets.max_bytes,
                  "Most bytes of the file and of all files it names: 200000, 200k, 5M")
      ->transform(CLI::AsSizeValue(true))
      ->check(kPositive);
  command
      .add_option("--max-error", arguments.max_error,
                  "Largest stated error of a whole payload: 1e-4, 0.5mm")
      ->check(kNotEmpty);
  command
      .add_option("--max-triangles", budgets.max_triangles,
                  "Most triangles of the finest surfaces, of all progressive meshes together")
      ->check(kPositive);
}

void add_source(CLI::App& command, ValidateArguments& arguments) {
  CLI::Option* source =
      command
          .add_option("--source", arguments.source,
                      "The scan that one progressive mesh was made of: its table of errors is "
                      "measured again")
          ->check(kNotEmpty);
  command
      .add_option("--fill-holes", arguments.repairs.fill_holes,
                  "What `convert` was given: errors are those of the changed scan")
      ->needs(source)
      ->check(kNotEmpty);
  command
      .add_option("--remove-handles", arguments.repairs.remove_handles, "What `convert` was given")
      ->needs(source)
      ->check(kNotEmpty);
}

}  // namespace

void add_validate(CLI::App& app, int& exit_code) {
  auto arguments = std::make_shared<ValidateArguments>();
  CLI::App* command = app.add_subcommand("validate", "Check files by decoding them");
  command
      ->add_option("inputs", arguments->inputs,
                   "Progressive .glb/.gltf, elementary .zt, or folders, which are searched for all "
                   "three")
      ->required()
      ->check(kNotEmpty);
  command
      ->add_option("-o,--output", arguments->report,
                   "JSON report in glTF-Validator's shape; an array for several files or a folder")
      ->check(kNotEmpty);
  command->add_option("--junit", arguments->junit, "JUnit XML report, a test case per file")
      ->check(kNotEmpty);
  command->add_flag("-q,--quiet", arguments->is_quiet, "Print errors only");
  add_budgets(*command, *arguments);
  add_source(*command, *arguments);
  command
      ->add_option("--random-prefixes", arguments->options.random_prefixes,
                   "Prefixes to decode beside those of the table; fewer of large surfaces, whose "
                   "vertices are at most 2^27 together, a base vertex counting 12 times [8]")
      ->check(CLI::Range(0, 1000000));
  command
      ->add_option("--max-vertices", arguments->options.max_vertices,
                   "Refuse surfaces of more vertices [16777216]")
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{0xffffffff}));
  command->callback([arguments, &exit_code] { exit_code = run_validate(*arguments); });
}

}  // namespace zerotree::cli
