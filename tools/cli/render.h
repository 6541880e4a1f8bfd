#pragma once
/// `shaolin render`: a picture of limit surfaces, of one model or a scene file.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>

#include "tools/cli/camera.h"
#include "tools/cli/command.h"
#include "tools/cli/model.h"

namespace shaolin {

struct RenderOptions {
  ModelOptions model;
  SceneOptions scene;               ///< --uniform
  std::filesystem::path exr;        ///< -o
  std::filesystem::path png;        ///< --png; empty: not written. So with the next two
  std::filesystem::path level_png;  ///< --png-level
  std::filesystem::path stats;      ///< --stats
  ImageSize size;                   ///< --size
  std::optional<Camera> camera;     ///< --camera; without it the scene file's, or one that frames all
  int threads = 0;                  ///< --threads; 0: all
};

/// Renders and writes the files, all or none of them. Throws InputError for bad input, std::exception if a file
/// cannot be written. Returns exit_done. The images do not depend on the number of threads.
int render(const RenderOptions& options);

/// Registers the subcommand.
void add_render(CLI::App& app, Command& command);

}  // namespace shaolin
