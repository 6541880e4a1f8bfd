#pragma once
/// `shaolin peers`: other libraries held to the shapes that they claim to subdivide.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <vector>

#include "tools/cli/command.h"

namespace shaolin {

struct PeersOptions {
  std::vector<std::filesystem::path> models;
  std::vector<std::filesystem::path> plugins;  ///< --plugin: schemes beside those of the models
};

/// Prints one table to stdout: scheme and shape class by library, the largest error in diagonals over the class's
/// models, or that the library does not offer it. What is said of other libraries is no failure: returns exit_done.
/// Throws InputError for bad input.
int peers(const PeersOptions& options);

/// Registers the subcommand.
void add_peers(CLI::App& app, Command& command);

}  // namespace shaolin
