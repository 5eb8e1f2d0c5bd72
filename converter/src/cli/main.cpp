// The command `zerotree`: parses the command line, runs a subcommand, turns failures into exit
// codes and sentences.
#include <malloc.h>

#include <cstdio>
#include <exception>
#include <new>

#include "cli/commands.h"
#include "mesh/error.h"

namespace {

constexpr const char* kFooter =
    "Errors are relative to the bounding box diagonal of the input unless a unit (mm, cm, m) says\n"
    "otherwise. Exit codes: 0 done, 1 internal error, 2 wrong usage, 3 unreadable input,\n"
    "4 refused topology, 5 target not reachable, 6 memory limit, 7 output failed its own check.\n"
    "`validate`: 0 no errors, 1 errors found, 2 could not run.";

int fail(zerotree::ExitCode code, const char* message) {
  std::fprintf(stderr, "zerotree: %s\n", message);
  return static_cast<int>(code);
}

int run(int argc, char** argv) {
  CLI::App app{"Zerotree: a scan becomes one glTF file that refines with every byte."};
  app.name("zerotree");
  app.require_subcommand(1);
  app.set_version_flag("--version", ZEROTREE_VERSION);
  app.footer(kFooter);
  int exit_code = 0;
  zerotree::cli::add_convert(app, exit_code);
  zerotree::cli::add_decode(app, exit_code);
  zerotree::cli::add_info(app, exit_code);
  zerotree::cli::add_validate(app, exit_code);
  zerotree::cli::add_compare(app, exit_code);
  zerotree::cli::add_render(app, exit_code);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    // Help and version are "errors" of CLI11 with code 0; all others are wrong usage.
    return app.exit(error) == 0 ? 0 : static_cast<int>(zerotree::ExitCode::usage);
  }
  return exit_code;
}

}  // namespace

int main(int argc, char** argv) {
  // The arrays of a stage go back to the system when the stage ends. By default glibc raises this
  // threshold as it sees large blocks freed, and then keeps them, holes and all.
  mallopt(M_MMAP_THRESHOLD, 1 << 18);
  try {
    return run(argc, argv);
  } catch (const zerotree::Error& error) {
    return fail(error.code(), error.what());
  } catch (const std::bad_alloc&) {
    return fail(zerotree::ExitCode::memory_limit,
                "out of memory: give the machine more, or convert a part of the model");
  } catch (const std::exception& error) {
    return fail(zerotree::ExitCode::internal, error.what());
  }
}
