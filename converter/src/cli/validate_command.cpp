#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <vector>

#include "cli/commands.h"
#include "export/atomic_file.h"
#include "mesh/error.h"
#include "validate/file_validation.h"
#include "validate/validation_report.h"

namespace zerotree::cli {
namespace {

// Exit codes of `validate` (README).
constexpr int kErrorsFound = 1, kCouldNotRun = 2;

struct ValidateArguments {
  std::vector<std::filesystem::path> inputs;
  std::filesystem::path report;
};

const char* severity_name(gltf::Severity severity) {
  switch (severity) {
    case gltf::Severity::error:
      return "error";
    case gltf::Severity::warning:
      return "warning";
    case gltf::Severity::information:
      return "info";
    case gltf::Severity::hint:
      return "hint";
  }
  return "";
}

void print_report(const validate::ValidationReport& report) {
  for (const gltf::Issue& issue : report.issues) {
    const gltf::IssueText& text = gltf::issue_text(issue.code);
    std::printf("%s: %s %s%s%s: %s\n", report.uri.c_str(), severity_name(text.severity), text.id,
                issue.pointer.empty() ? "" : " at ", issue.pointer.c_str(),
                gltf::issue_message(issue).c_str());
  }
  std::printf("%s: %zu errors, %zu warnings\n", report.uri.c_str(),
              validate::count_issues(report, gltf::Severity::error),
              validate::count_issues(report, gltf::Severity::warning));
}

int run_validate(const ValidateArguments& arguments) {
  int exit_code = 0;
  nlohmann::ordered_json reports = nlohmann::ordered_json::array();
  for (const std::filesystem::path& input : arguments.inputs) {
    try {
      const validate::ValidationReport report = validate::validate_file(input);
      print_report(report);
      reports.push_back(validate::to_json(report));
      if (gltf::first_error(report.issues) != nullptr && exit_code == 0) exit_code = kErrorsFound;
    } catch (const Error& error) {
      std::fprintf(stderr, "zerotree: %s\n", error.what());
      exit_code = kCouldNotRun;
    }
  }
  if (!arguments.report.empty())
    exporter::write_file_atomically(arguments.report,
                                    (reports.size() == 1 ? reports[0] : reports).dump(2) + "\n");
  return exit_code;
}

}  // namespace

void add_validate(CLI::App& app, int& exit_code) {
  auto arguments = std::make_shared<ValidateArguments>();
  CLI::App* command = app.add_subcommand("validate", "Check files by decoding them");
  command->add_option("inputs", arguments->inputs, "Progressive .glb/.gltf or elementary .zt")
      ->required();
  command->add_option("-o,--output", arguments->report,
                      "JSON report in glTF-Validator's shape; an array for several files");
  command->callback([arguments, &exit_code] { exit_code = run_validate(*arguments); });
}

}  // namespace zerotree::cli
