#pragma once
/// `shaolin query`: rays from a file or the command line, hits to a file.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "tools/cli/command.h"
#include "tools/cli/csv.h"
#include "tools/cli/model.h"

namespace shaolin {

struct QueryOptions {
  ModelOptions model;
  SceneOptions scene;                            ///< --uniform
  std::filesystem::path file;                    ///< --rays
  std::vector<std::string> rays;                 ///< --ray, each as a row of the file
  std::filesystem::path hits = standard_output;  ///< -o
  enum class Answer {
    closest,
    any,   ///< --any: only whether a ray hits
    all,   ///< --all: every hit
    count  ///< --count: how many of them are crossings
  } answer = Answer::closest;
  int threads = 0;  ///< --threads; 0: all
};

/// Answers every ray, in order, and says on the standard error how many answers are not certified. Throws InputError
/// for bad input, with the line of a bad ray. Returns exit_done. The output does not depend on the number of threads.
int query(const QueryOptions& options);

/// Registers the subcommand.
void add_query(CLI::App& app, Command& command);

}  // namespace shaolin
