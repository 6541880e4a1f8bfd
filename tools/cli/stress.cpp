#include "tools/cli/stress.h"

#include <cstdio>
#include <iostream>
#include <memory>

#include "tools/bench/report_folder.h"
#include "tools/cli/model.h"
#include "tools/cli/number_checks.h"
#include "tools/cli/threads.h"
#include "tools/stress/meshes.h"
#include "tools/stress/report.h"
#include "tools/stress/run.h"

namespace shaolin {
namespace {

/// A file's name may say its scheme ("loop_cube.obj"), as those of OpenSubdiv's shapes do, where the file does not.
std::string scheme_in_name(const std::filesystem::path& file) {
  const std::string name = file.stem().string();
  for (const char* scheme : {"loop", "catmark", "bilinear"})
    if (name.find(scheme) != std::string::npos) return scheme;
  return {};
}

std::vector<stress::StressModel> models_of(const StressOptions& options) {
  if (options.models.empty()) return stress::sound_models();
  std::vector<stress::StressModel> models;
  for (const auto& file : options.models) {
    LoadedModel model = load_model({file, {}, {}});
    std::string scheme = model.mesh.scheme.empty() ? scheme_in_name(file) : std::string();
    if (scheme.empty()) scheme = model.scheme;
    models.push_back({file.stem().string(), std::move(model.mesh), std::move(scheme)});
  }
  return models;
}

std::vector<std::string> family_names() {
  std::vector<std::string> names;
  for (const stress::Family& family : stress::families()) names.push_back(family.name);
  return names;
}

std::string families_in_words() {
  std::string text = "Families of rays:\n";
  for (const stress::Family& family : stress::families()) text += "  " + family.name + ": " + family.meaning + '\n';
  return text;
}

}  // namespace

int stress_models(const StressOptions& options) {
  // First, so that a report that cannot be written costs no minutes.
  if (!options.report.empty()) make_report_folder(options.report);
  stress::RunOptions run_options{.models = models_of(options),
                                 .families = options.families,
                                 .seed = options.seed,
                                 .rays = options.rays,
                                 .minutes = options.minutes};
  std::optional<stress::Peers> peers;
  if (options.peers_level) run_options.peers = &peers.emplace(*options.peers_level);
  stress::Result result;
  run_with_threads(options.threads, [&] {
    result = stress::run(run_options, [&](std::size_t rays) {
      if (options.minutes > 0) std::fprintf(stderr, "%zu rays of each family at each model\n", rays);
    });
  });
  stress::print(std::cout, result, options.seed);
  if (peers) {
    std::cout << "\nclosest hits of peers, against our own:\n\n";
    write_markdown(std::cout, peers->table());
  }
  if (!options.report.empty()) stress::write_report(options.report, result, run_options);
  return result.passed() ? exit_done : exit_check_failed;
}

void add_stress(CLI::App& app, Command& command) {
  const auto options = std::make_shared<StressOptions>();
  CLI::App* sub = app.add_subcommand("stress",
                                     "Throw rays of the kinds that are lost most easily, and count hits that are lost, "
                                     "made up or reported twice; exits "
                                     "with 1 if there are any");
  sub->footer(families_in_words());
  sub->add_option("MODEL", options->models, "OBJ files; none: small models made by code");
  const auto rays = sub->add_option("--rays", options->rays, "Rays of each family at each model")
                        ->check(CLI::Range(std::size_t{1}, std::size_t{10000000000}))
                        ->capture_default_str();
  sub->add_option("--minutes", options->minutes, "As many rays as there is time for")
      ->check(is_positive())
      ->excludes(rays);
  sub->add_option("--family", options->families, "Some of the families")
      ->check(CLI::IsMember(family_names()))
      ->type_name("NAME");
  add_seed_option(*sub, options->seed);
  sub->add_option("--peers", options->peers_level,
                  "Ask Embree's triangles, its subdivision and CGAL's tree the same rays, at this level of refinement")
      ->check(CLI::Range(1, 8))
      ->type_name("LEVEL");
  sub->add_option("--report", options->report, "Folder for tables and failed rays")->type_name("DIR");
  add_threads_option(*sub, options->threads);
  sub->callback([options, &command] { command = [options] { return stress_models(*options); }; });
}

}  // namespace shaolin
