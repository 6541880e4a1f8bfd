#pragma once
/// `shaolin sweep`: where moving spheres first touch the surface.
#include <CLI/CLI.hpp>
#include <filesystem>

#include "tools/cli/command.h"
#include "tools/cli/model.h"
#include "tools/cli/row_input.h"

namespace shaolin {

struct SweepOptions {
  ModelOptions model;
  SceneOptions scene;
  RowInput sweeps{{"sphere",
                   "spheres",
                   "x,y,z,dx,dy,dz,radius",
                   {7},
                   "A sphere by its centre, the way that it goes, and its radius"}};
  std::filesystem::path output;  ///< -o
  int threads = 0;               ///< --threads; 0: all
};

/// Answers every sweep, in order. Throws InputError for bad input, with the line of a bad sweep. Returns exit_done. The
/// output does not depend on the number of threads.
int sweep(const SweepOptions& options);

/// Registers the subcommand.
void add_sweep(CLI::App& app, Command& command);

}  // namespace shaolin
