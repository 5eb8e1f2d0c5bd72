// The subcommands of `zerotree`. Each adds its options to the application; when the user names
// it, it runs and stores its exit code.
#pragma once

#include <CLI/CLI.hpp>

namespace zerotree::cli {

void add_convert(CLI::App& app, int& exit_code);
void add_decode(CLI::App& app, int& exit_code);
void add_info(CLI::App& app, int& exit_code);
void add_validate(CLI::App& app, int& exit_code);
void add_compare(CLI::App& app, int& exit_code);
void add_render(CLI::App& app, int& exit_code);

}  // namespace zerotree::cli
