#pragma once
/// `shaolin scheme`: the schemes by name, their masks, and the conformance kit.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>

#include "tools/cli/command.h"

namespace shaolin {

/// Prints a line per built-in scheme.
int scheme_list();

/// `NAME` or `--plugin FILE`.
struct SchemeChoice {
  std::string name;              ///< a built-in scheme; empty: the plug-in's
  std::filesystem::path plugin;  ///< see load_plugin()
};

/// Prints a scheme's masks and eigenvalues by valence. Throws InputError for an unknown name or a plug-in that cannot
/// be used.
int scheme_show(const SchemeChoice& choice);

struct SchemeCheckOptions {
  SchemeChoice choice;
  std::filesystem::path report;  ///< folder for NAME.html; empty: none
  int most_faces = 40;           ///< around the smooth and dart vertices that are looked at; 3 or more
};

/// Runs the conformance kit and prints its table. Returns exit_check_failed if a check failed. Throws InputError for an
/// unknown name, a plug-in that cannot be used, or a folder that cannot be written to.
int scheme_check(const SchemeCheckOptions& options);

/// Registers the subcommand.
void add_scheme(CLI::App& app, Command& command);

}  // namespace shaolin
