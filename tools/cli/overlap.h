#pragma once
/// `shaolin overlap`: which shapes have a point in common with the surface, and one such point.
#include <CLI/CLI.hpp>
#include <filesystem>

#include "tools/cli/command.h"
#include "tools/cli/model.h"
#include "tools/cli/row_input.h"

namespace shaolin {

struct OverlapOptions {
  ModelOptions model;
  SceneOptions scene;
  /// Of one kind at a time: --spheres or --sphere, and so on.
  RowInput spheres{{"sphere", "spheres", "x,y,z,radius", {4}, "A ball"}};
  RowInput boxes{{"box",
                  "boxes",
                  "x,y,z,hx,hy,hz,ax,ay,az,degrees",
                  {6, 10},
                  "A box by its centre and half its extents, which may be turned about an axis"}};
  RowInput capsules{
      {"capsule", "capsules", "x,y,z,tx,ty,tz,radius", {7}, "All within a radius of the way from a point to another"}};
  RowInput triangles{{"triangle", "triangles", "x,y,z,bx,by,bz,cx,cy,cz", {9}, "A triangle"}};
  std::filesystem::path output;  ///< -o
  int threads = 0;               ///< --threads; 0: all
};

/// Answers every shape, in order. Throws InputError for bad input, with the line of a bad shape. Returns exit_done. The
/// output does not depend on the number of threads.
int overlap(const OverlapOptions& options);

/// Registers the subcommand.
void add_overlap(CLI::App& app, Command& command);

}  // namespace shaolin
