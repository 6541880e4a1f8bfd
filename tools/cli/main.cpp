/// The command-line tool: chooses a subcommand and maps its outcome to the exit status.
#include <CLI/CLI.hpp>
#include <exception>
#include <iostream>
#include <new>
#include <string>
#include <vector>

#include "schemes/errors.h"
#include "tools/bench/bench.h"
#include "tools/cli/closest.h"
#include "tools/cli/command.h"
#include "tools/cli/eval.h"
#include "tools/cli/info.h"
#include "tools/cli/inside.h"
#include "tools/cli/overlap.h"
#include "tools/cli/peers.h"
#include "tools/cli/pick.h"
#include "tools/cli/query.h"
#include "tools/cli/render.h"
#include "tools/cli/scheme.h"
#include "tools/cli/stress.h"
#include "tools/cli/sweep.h"
#include "tools/cli/unfinished_files.h"
#include "tools/cli/validate.h"

namespace shaolin {
namespace {

const char* const description =
    "Ray, distance and collision queries on the limit surface of subdivision meshes (Loop, Catmull-Clark), without "
    "tessellation.\n"
    "'shaolin SUBCOMMAND --help' explains a subcommand.";

const char* const footer =
    "Models are Wavefront OBJ files with OpenSubdiv's tag lines.\n"
    "Exit status: 0 done, 1 a check failed, 2 usage, 3 bad input.";

int run(const Command& command) {
  try {
    return command();
  } catch (const InputError& error) {
    std::cerr << "shaolin: error: " << error.what() << '\n';
  } catch (const std::bad_alloc&) {
    std::cerr << "shaolin: error: out of memory\n";
  } catch (const std::exception& error) {
    std::cerr << "shaolin: error: " << error.what() << '\n';
  }
  return exit_bad_input;
}

int parse_and_run(int argc, char** argv) {
  CLI::App app(description, "shaolin");
  app.footer(footer);
  app.set_version_flag("--version", std::string("shaolin ") + SHAOLIN_VERSION);
  app.require_subcommand(1);

  Command command;
  add_render(app, command);
  add_query(app, command);
  add_closest(app, command);
  add_inside(app, command);
  add_overlap(app, command);
  add_sweep(app, command);
  add_pick(app, command);
  add_eval(app, command);
  add_info(app, command);
  add_validate(app, command);
  add_stress(app, command);
  add_scheme(app, command);
  add_peers(app, command);
  add_bench(app, command);

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    // A word that no command knows says more than what is missing then, which is looked for before.
    const std::vector<std::string> unknown = app.remaining(true);
    if (error.get_exit_code() != 0 && !unknown.empty()) {
      app.exit(CLI::ExtrasError(unknown));
      return exit_usage;
    }
    return app.exit(error) == 0 ? exit_done : exit_usage;  // --help and --version arrive here too, with status 0
  }
  return run(command);
}

}  // namespace
}  // namespace shaolin

int main(int argc, char** argv) {
  shaolin::remove_unfinished_files_when_stopped();
  return shaolin::parse_and_run(argc, argv);
}
