#pragma once
/// From a model's file name to a surface or a scene: the part that all subcommands share.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "intersect/scene.h"
#include "schemes/control_mesh.h"
#include "schemes/limit_surface.h"
#include "schemes/runtime_scheme.h"
#include "tools/cli/distinct_files.h"

namespace shaolin {

/// `MODEL`, and `--scheme` or `--plugin`.
struct ModelOptions {
  std::filesystem::path file;
  std::string scheme;            ///< a built-in scheme; empty: what the mesh asks for, see default_scheme()
  std::filesystem::path plugin;  ///< a shared library with a scheme, see load_plugin(); empty: none
};

/// The files that it names, for expect_distinct_files().
std::vector<NamedFile> inputs_of(const ModelOptions& options);

/// Adds --uniform LEVEL, which makes it a scene of triangles, and --chord EPSILON and --a3 EPSILON, of chord faces,
/// with --min-size and --max-size; and --memory-budget.
void add_method_options(CLI::App& app, SceneOptions& options);

/// Adds --memory-budget MiB, one for all that is built with the options.
CLI::Option* add_budget_option(CLI::App& app, SceneOptions& options);

/// Says on stderr what is held and was dropped, if there is a budget.
void report_budget(const Scene& scene, const SceneOptions& options);

/// Accepts the names of the built-in schemes.
CLI::Validator is_scheme_name();

/// Adds the positional MODEL (required), and --scheme and --plugin, which exclude each other. `what` describes MODEL.
void add_model_options(CLI::App& app, ModelOptions& options,
                       const std::string& what = "The control mesh: an OBJ file with OpenSubdiv's tag lines");

/// Adds --scheme and --plugin alone.
void add_scheme_options(CLI::App& app, ModelOptions& options);

/// Adds --plugin FILE.
CLI::Option* add_plugin_option(CLI::App& app, std::filesystem::path& file);

/// A mesh as read, and the scheme to subdivide it with.
struct LoadedModel {
  ControlMesh mesh;
  std::string scheme;                        ///< its name
  std::shared_ptr<const SchemeMasks> masks;  ///< of a plug-in; null: `scheme` is built in
};

/// Reads the OBJ file and settles the scheme; a plug-in is loaded, and runs. Prints the mesh's warnings to stderr.
/// Throws InputError, for a scene file, too.
LoadedModel load_model(const ModelOptions& options);

/// Build the surface, the object or a scene of it alone; warnings that arise only then go to stderr, too. Throw
/// InputError.
std::unique_ptr<LimitSurface> build_surface(LoadedModel model);
std::shared_ptr<const Object> build_object(LoadedModel model, const SceneOptions& options = {});
Scene build_scene(LoadedModel model, const SceneOptions& options = {});

}  // namespace shaolin
