#pragma once
/// `shaolin inside`: which points are inside of closed surfaces, and how far from them.
#include <CLI/CLI.hpp>
#include <filesystem>

#include "tools/cli/closest.h"

namespace shaolin {

struct InsideOptions {
  ModelOptions model;
  SceneOptions scene;
  RowInput points{point_format()};  ///< --points or --point
  std::filesystem::path output;     ///< -o
  int threads = 0;                  ///< --threads; 0: all
};

/// Answers every point, in order. Throws InputError for bad input, and for a surface that is open, which it names.
/// Returns exit_done. The output does not depend on the number of threads.
int inside(const InsideOptions& options);

/// Registers the subcommand.
void add_inside(CLI::App& app, Command& command);

}  // namespace shaolin
