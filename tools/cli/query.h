#pragma once
/// `shaolin query`: rays from a file, hits to a file.
#include <CLI/CLI.hpp>
#include <filesystem>

#include "tools/cli/command.h"
#include "tools/cli/model.h"

namespace shaolin {

struct QueryOptions {
  ModelOptions model;
  SceneOptions scene;          ///< --uniform
  std::filesystem::path rays;  ///< --rays
  std::filesystem::path hits;  ///< -o
  enum class Answer {
    closest,
    any,   ///< --any: only whether a ray hits
    all,   ///< --all: every hit
    count  ///< --count: how many of them are crossings
  } answer = Answer::closest;
  int threads = 0;  ///< --threads; 0: all
};

/// Answers every ray of the file, in order. Throws InputError for bad input, with the line of a bad ray. Returns
/// exit_done. The output does not depend on the number of threads.
int query(const QueryOptions& options);

/// Registers the subcommand.
void add_query(CLI::App& app, Command& command);

}  // namespace shaolin
