#include "tools/cli/model.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <utility>

#include "intersect/patch_budget.h"
#include "schemes/builtin.h"
#include "schemes/load_plugin.h"
#include "schemes/obj.h"
#include "tools/cli/number_checks.h"
#include "tools/cli/scene_file.h"

namespace shaolin {
namespace {

/// Prints the warnings from index `first` on.
void print_warnings(const ControlMesh& mesh, std::size_t first) {
  for (std::size_t i = first; i < mesh.warnings.size(); ++i)
    std::cerr << "shaolin: warning: " << mesh.warnings[i] << '\n';
}

/// Throws InputError for a scheme that is not built in: it comes from the file.
FaceKind face_kind_of(const std::string& scheme, const MeshPlaces& places) {
  for (const BuiltinScheme& known : builtin_schemes())
    if (scheme == known.name) return known.face_kind;
  throw InputError("unknown scheme '" + scheme + "'; expected " + builtin_scheme_names(), places.file, places.scheme);
}

/// A part of a byte is a byte; more than any machine has is no bound.
std::shared_ptr<PatchBudget> budget_of(double mebibytes) {
  return std::make_shared<PatchBudget>(static_cast<std::uint64_t>(std::min(std::ceil(mebibytes * 0x1p20), 0x1p63)));
}

}  // namespace

std::vector<NamedFile> inputs_of(const ModelOptions& options) {
  return {{"MODEL", options.file}, {"--plugin", options.plugin}};
}

CLI::Validator is_scheme_name() {
  std::vector<std::string> names;
  for (const BuiltinScheme& scheme : builtin_schemes()) names.emplace_back(scheme.name);
  return CLI::IsMember(names);
}

void add_model_options(CLI::App& app, ModelOptions& options, const std::string& what) {
  app.add_option("MODEL", options.file, what)->required();
  add_scheme_options(app, options);
}

void add_scheme_options(CLI::App& app, ModelOptions& options) {
  CLI::Option* const scheme = app.add_option(
      "--scheme", options.scheme,
      "Subdivision scheme: " + builtin_scheme_names() +
          " (default: the file's 't scheme' tag; without it, loop if all faces are triangles, else catmark)");
  scheme->check(is_scheme_name())->type_name("NAME");
  add_plugin_option(app, options.plugin)->excludes(scheme);
}

CLI::Option* add_plugin_option(CLI::App& app, std::filesystem::path& file) {
  return app.add_option("--plugin", file, "A shared library with a scheme (see docs/schemes.md), whose code is run")
      ->type_name("FILE");
}

CLI::Option* add_budget_option(CLI::App& app, SceneOptions& options) {
  return app
      .add_option_function<double>(
          "--memory-budget", [&options](double mebibytes) { options.budget = budget_of(mebibytes); },
          "Most memory, in MiB, that what queries refine may hold, of all objects together; beyond it, what none "
          "needed "
          "for the longest is dropped and made anew when needed: slower, same answers (default: all is kept)")
      ->check(is_positive())
      ->type_name("MiB");
}

void report_budget(const Scene& scene, const SceneOptions& options) {
  if (!options.budget) return;
  std::cerr << "memory budget: " << options.budget->held() << " of " << options.budget->bytes() << " bytes held, "
            << scene.statistics().patches_evicted << " patches dropped\n";
}

void add_method_options(CLI::App& app, SceneOptions& options) {
  CLI::Option* const uniform =
      app.add_option_function<int>(
             "--uniform",
             [&options](int level) {
               options.method = Method::uniform;
               options.level = level;
             },
             "For comparison: rays meet triangles in place of the limit surface, of a tessellation at this level")
          ->check(CLI::Range(1, 10))
          ->type_name("LEVEL");
  const auto add_chords = [&](const std::string& name, Method method, const std::string& what) {
    return app
        .add_option_function<double>(
            name,
            [&options, method](double epsilon) {
              options.method = method;
              options.chord.epsilon = epsilon;
            },
            what)
        ->check(is_positive())
        ->type_name("EPSILON")
        ->excludes(uniform);
  };
  CLI::Option* const chord =
      add_chords("--chord", Method::chord,
                 "For comparison: rays meet chord faces, refined until they are this near (a length), by the ShaoLin "
                 "algorithm as published");
  CLI::Option* const a3 =
      add_chords("--a3", Method::a3, "For comparison: the same chord faces by the algorithm that it was compared with");
  a3->excludes(chord);
  const auto add_size = [&](const std::string& name, double& size, const std::string& what) {
    return app.add_option(name, size, "With --chord or --a3: " + what + ", in pixels")
        ->check(is_not_negative())
        ->type_name("PIXELS")
        ->capture_default_str();
  };
  CLI::Option* const least =
      add_size("--min-size", options.chord.min_size, "chord faces smaller than this are not refined");
  CLI::Option* const largest =
      add_size("--max-size", options.chord.max_size, "chord faces larger than this are refined");
  add_budget_option(app, options)->excludes(uniform);
  app.parse_complete_callback([&options, chord, a3, least, largest] {
    if (least->count() + largest->count() > 0 && chord->count() + a3->count() == 0)
      throw CLI::ValidationError("--min-size and --max-size need --chord or --a3");
    if (largest->count() == 0) options.chord.max_size = std::max(options.chord.min_size, options.chord.max_size);
    if (options.chord.max_size < options.chord.min_size)
      throw CLI::ValidationError("--max-size: is smaller than --min-size");
  });
}

LoadedModel load_model(const ModelOptions& options) {
  if (is_scene_file(options.file))
    throw InputError("is a scene file; expected a model (an OBJ file)", options.file.string());
  LoadedModel model;
  MeshPlaces places;
  model.mesh = read_obj(options.file, places);
  if (!options.plugin.empty()) {
    LoadedPlugin plugin = load_plugin(options.plugin);
    model.scheme = std::move(plugin.name);
    model.masks = std::move(plugin.masks);
  } else {
    model.scheme = options.scheme.empty() ? default_scheme(model.mesh) : options.scheme;
  }
  check_faces(model.mesh, model.masks ? model.masks->face_kind() : face_kind_of(model.scheme, places), places);
  print_warnings(model.mesh, 0);
  return model;
}

std::unique_ptr<LimitSurface> build_surface(LoadedModel model) {
  const std::size_t printed = model.mesh.warnings.size();
  auto surface = model.masks ? make_limit_surface(std::move(model.mesh), model.masks)
                             : make_limit_surface(std::move(model.mesh), model.scheme);
  print_warnings(surface->control_mesh(), printed);
  return surface;
}

std::shared_ptr<const Object> build_object(LoadedModel model, const SceneOptions& options) {
  const std::size_t printed = model.mesh.warnings.size();
  auto object = model.masks ? make_object(std::move(model.mesh), model.masks, options)
                            : make_object(std::move(model.mesh), model.scheme, options);
  print_warnings(object->surface().control_mesh(), printed);
  return object;
}

Scene build_scene(LoadedModel model, const SceneOptions& options) {
  return Scene({Instance{build_object(std::move(model), options)}});
}

}  // namespace shaolin
