#pragma once
/// `shaolin info`: what a model consists of.
#include <CLI/CLI.hpp>

#include "tools/cli/command.h"
#include "tools/cli/model.h"

namespace shaolin {

struct InfoOptions {
  ModelOptions model;
};

/// Prints the table to stdout. Throws InputError for bad input. Returns exit_done.
int info(const InfoOptions& options);

/// Registers the subcommand.
void add_info(CLI::App& app, Command& command);

}  // namespace shaolin
