#pragma once
/// From a model's file name to a surface or a scene: the part that all subcommands share.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>

#include "intersect/scene.h"
#include "schemes/control_mesh.h"
#include "schemes/limit_surface.h"

namespace shaolin {

/// `MODEL` and `--scheme`.
struct ModelOptions {
  std::filesystem::path file;
  std::string scheme;  ///< a built-in scheme; empty: what the mesh asks for, see default_scheme()
};

/// Accepts the names of the built-in schemes.
CLI::Validator is_scheme_name();

/// Adds the positional MODEL (required) and --scheme.
void add_model_options(CLI::App& app, ModelOptions& options);

/// A mesh as read, and the scheme to subdivide it with.
struct Model {
  ControlMesh mesh;
  std::string scheme;
};

/// Reads the OBJ file and settles the scheme. Prints the mesh's warnings to stderr. Throws InputError.
Model load_model(const ModelOptions& options);

/// Builds the surface or the scene; warnings that arise only then go to stderr, too. Throw InputError.
std::unique_ptr<LimitSurface> build_surface(Model model);
Scene build_scene(Model model);

}  // namespace shaolin
