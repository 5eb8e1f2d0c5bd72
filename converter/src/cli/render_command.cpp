#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "cli/commands.h"
#include "cli/terminal_progress.h"
#include "import/import_mesh.h"
#include "mesh/error.h"
#include "picture/comparison_sheet.h"

namespace zerotree::cli {
namespace {

struct RenderArguments {
  std::vector<std::filesystem::path> inputs;
  std::filesystem::path output;
  std::vector<std::string> captions;
  picture::SheetOptions sheet;
};

// "\n" as two characters is how a caption's line break passes a shell.
std::string unescape_line_breaks(const std::string& caption) {
  std::string result;
  for (std::size_t i = 0; i < caption.size(); ++i) {
    const bool is_break = caption.compare(i, 2, "\\n") == 0;
    result.push_back(is_break ? '\n' : caption[i]);
    if (is_break) ++i;
  }
  return result;
}

void run_render(const RenderArguments& arguments) {
  if (!arguments.captions.empty() && arguments.captions.size() != arguments.inputs.size())
    throw Error(ExitCode::usage, "render: give one --caption per mesh, or none");
  std::vector<TriangleMesh> meshes;
  TerminalProgress progress;
  for (const std::filesystem::path& input : arguments.inputs)
    meshes.push_back(importer::import_mesh(input, {}, progress.callback()).mesh);
  std::vector<picture::Panel> panels;
  for (std::size_t i = 0; i < meshes.size(); ++i)
    panels.push_back({picture::Model{&meshes[i]},
                      arguments.captions.empty() ? arguments.inputs[i].filename().string()
                                                 : unescape_line_breaks(arguments.captions[i])});
  report_progress(progress.callback(), "rendering", 0);
  picture::write_comparison(arguments.output, panels, arguments.sheet);
}

}  // namespace

void add_render(CLI::App& app, int& exit_code) {
  auto arguments = std::make_shared<RenderArguments>();
  CLI::App* command =
      app.add_subcommand("render", "Draw meshes side by side, shaded, as a PNG picture");
  command->add_option("meshes", arguments->inputs, "The original first: its camera serves all")
      ->required();
  command->add_option("-o,--output", arguments->output, "Picture to write (.png)")->required();
  command->add_option("--caption", arguments->captions, "One per mesh; \\n breaks the line")
      ->take_all();
  command->add_option("--size", arguments->sheet.width, "Width of the picture in pixels [2400]")
      ->check(CLI::Range(64, 32768));
  command->add_option("--columns", arguments->sheet.columns, "Meshes in a row [auto]")
      ->check(CLI::Range(1, 100));
  command->callback([arguments, &exit_code] {
    run_render(*arguments);
    exit_code = 0;
  });
}

}  // namespace zerotree::cli
