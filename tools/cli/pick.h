#pragma once
/// `shaolin pick`: the faces behind rectangles of a picture, or in a convex region.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>

#include "tools/cli/camera.h"
#include "tools/cli/command.h"
#include "tools/cli/model.h"
#include "tools/cli/row_input.h"

namespace shaolin {

struct PickOptions {
  ModelOptions model;
  SceneOptions scene;
  RowInput rectangles{{"rectangle",
                       "rectangles",
                       "left,top,right,bottom",
                       {4},
                       "A rectangle of the picture, in pixels from its upper left corner"}};
  RowInput sides{
      {"side", "sides", "nx,ny,nz,offset", {4}, "A side of one region: the points x with n . x <= offset are in it"}};
  std::optional<Camera> camera;  ///< --camera, for rectangles; empty: as a picture's
  ImageSize size;                ///< --size, for rectangles
  std::filesystem::path output;  ///< -o
  int threads = 0;               ///< --threads; 0: all
};

/// Answers every rectangle, in order, or the one region that all sides make. Throws InputError for bad input, with the
/// line of a bad row. Returns exit_done. The output does not depend on the number of threads.
int pick(const PickOptions& options);

/// Registers the subcommand.
void add_pick(CLI::App& app, Command& command);

}  // namespace shaolin
