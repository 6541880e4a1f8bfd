#pragma once
/// `shaolin closest`: points from a file or from the command line, the closest points of the surface to a file.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <limits>

#include "tools/cli/command.h"
#include "tools/cli/model.h"
#include "tools/cli/row_input.h"

namespace shaolin {

/// Points, for the subcommands that take them.
inline RowFormat point_format() { return {"point", "points", "x,y,z", {3}, "A point"}; }

struct ClosestOptions {
  ModelOptions model;
  SceneOptions scene;
  RowInput points{point_format()};                          ///< --points or --point
  double radius = std::numeric_limits<double>::infinity();  ///< --radius
  std::filesystem::path output;                             ///< -o
  int threads = 0;                                          ///< --threads; 0: all
};

/// Answers every point, in order: those of the file, or those of the command line. Throws InputError for bad input,
/// with the line of a bad point. Returns exit_done. The output does not depend on the number of threads.
int closest(const ClosestOptions& options);

/// Registers the subcommand.
void add_closest(CLI::App& app, Command& command);

}  // namespace shaolin
