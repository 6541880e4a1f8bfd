#pragma once
/// `shaolin eval`: points of the limit surface at given parameters.
#include <CLI/CLI.hpp>
#include <filesystem>

#include "tools/cli/command.h"
#include "tools/cli/model.h"

namespace shaolin {

struct EvalOptions {
  ModelOptions model;
  std::filesystem::path parameters;  ///< --params
  std::filesystem::path output;      ///< -o
  int threads = 0;                   ///< --threads; 0: all
};

/// Evaluates at every parameter of the file, in order. Throws InputError for bad input, with the line of a bad
/// parameter. Returns exit_done. The output does not depend on the number of threads.
int eval(const EvalOptions& options);

/// Registers the subcommand.
void add_eval(CLI::App& app, Command& command);

}  // namespace shaolin
