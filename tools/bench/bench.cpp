#include "tools/bench/bench.h"

#include <memory>

#include "tools/bench/closest.h"
#include "tools/bench/lost.h"
#include "tools/bench/moved.h"
#include "tools/bench/paper.h"
#include "tools/bench/pareto.h"
#include "tools/bench/scaling.h"
#include "tools/cli/number_checks.h"
#include "tools/cli/parse_into.h"
#include "tools/cli/threads.h"

namespace shaolin {
namespace {

void add_size_option(CLI::App& app, ImageSize& size) {
  app.add_option_function<std::string>("--size", parse_into(size, parse_size, "--size"), "Size in pixels")
      ->type_name("WxH")
      ->default_str(std::to_string(size.width) + "x" + std::to_string(size.height));
}

void add_runs_option(CLI::App& app, int& runs) {
  app.add_option("--runs", runs, "Runs of each time; medians are shown")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
}

void add_measure_options(CLI::App& app, MeasureOptions& options, int& most_level, int& threads) {
  add_runs_option(app, options.runs);
  app.add_option("--level", most_level, "The highest level of uniform triangles and of Embree's")
      ->check(CLI::Range(1, 10))
      ->capture_default_str();
  app.add_option_function<std::size_t>(
         "--memory", [&options](std::size_t mebibytes) { options.most_bytes = mebibytes << 20; },
         "What triangles may occupy: levels that would need more are estimated, not run; also what methods may "
         "occupy together that are timed in turns")
      ->check(CLI::Range(std::size_t{1}, std::size_t{1} << 20))
      ->type_name("MiB")
      ->default_str("1024");
  add_threads_option(app, threads);
}

void add_chord_options(CLI::App& app, std::optional<double>& unit, double& min_size, std::optional<double>& max_size) {
  app.add_option("--unit", unit,
                 "The length that an epsilon of 1 stands for (default: the paper's scenes have their own, see "
                 "docs/bench.md; else a fiftieth of the diagonal)")
      ->check(is_positive());
  app.add_option("--min-size", min_size, "Pixels: what is smaller is not refined")
      ->check(is_not_negative())
      ->capture_default_str();
  app.add_option("--max-size", max_size, "Pixels: what is larger is refined (default: 12; 20 in Eggs'n'Bunnies)")
      ->check(is_not_negative());
  app.parse_complete_callback([&min_size, &max_size] {
    if (max_size && *max_size < min_size) throw CLI::ValidationError("--max-size: is smaller than --min-size");
  });
}

void add_report_option(CLI::App& app, std::filesystem::path& report) {
  app.add_option("--report", report, "Folder for the page, CSV files and pictures")->required()->type_name("DIR");
}

void add_methods_option(CLI::App& app, std::vector<std::string>& methods) {
  std::vector<std::string> names;
  for (const ContenderKind kind : contender_kinds) names.emplace_back(name_of(kind));
  app.add_option("--methods", methods,
                 "Some of the methods, with commas in between, in place of all; the exact one always is one of them")
      ->check(CLI::IsMember(names))
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name("NAME");
}

void add_paper(CLI::App& app, Command& command) {
  const auto options = std::make_shared<PaperOptions>();
  CLI::App* sub = app.add_subcommand(
      "paper",
      "Tables 1 to 4, Figures 14 and 15 of the paper: levels, memory, times and level maps of its three scenes");
  add_size_option(*sub, options->size);
  add_report_option(*sub, options->report);
  sub->add_option("--scenes", options->scenes, "Folder of the scene files")->type_name("DIR")->capture_default_str();
  std::vector<std::string> names;
  for (const PaperScene& scene : paper_scenes()) names.emplace_back(scene.file);
  sub->add_option("--only", options->only, "Some of the scenes")->check(CLI::IsMember(names))->type_name("NAME");
  sub->add_flag("--catmark", options->quads, "The scenes' versions in quads, for Catmull-Clark");
  add_measure_options(*sub, options->measure, options->most_level, options->threads);
  sub->callback([options, &command] { command = [options] { return bench_paper(*options); }; });
}

void add_pareto(CLI::App& app, Command& command) {
  const auto options = std::make_shared<ParetoOptions>();
  CLI::App* sub = app.add_subcommand(
      "pareto",
      "Time and memory against error: the exact method, ShaoLin and A3 over epsilon, uniform triangles "
      "and Embree 3 by level");
  sub->add_option("SCENE", options->files, "OBJ files or scene files")->required();
  add_scheme_options(*sub, options->scheme);
  add_size_option(*sub, options->size);
  add_report_option(*sub, options->report);
  add_chord_options(*sub, options->unit, options->min_size, options->max_size);
  sub->add_option("--exact-hits", options->exact_hits,
                  "Hits of the exact method that are held against the control mesh, refined in quadruple precision")
      ->check(CLI::Range(std::size_t{0}, std::size_t{1000000}))
      ->capture_default_str();
  add_methods_option(*sub, options->methods);
  add_measure_options(*sub, options->measure, options->most_level, options->threads);
  sub->callback([options, &command] { command = [options] { return bench_pareto(*options); }; });
}

void add_scaling(CLI::App& app, Command& command) {
  const auto options = std::make_shared<ScalingOptions>();
  CLI::App* sub = app.add_subcommand(
      "scaling", "What a scene costs as its control mesh grows: build, first image, one and two threads, instances");
  sub->add_option("--faces", options->faces, "Control faces, about, of one mesh after the other")
      ->check(CLI::Range(std::size_t{9}, std::size_t{100000000}))
      ->capture_default_str();
  sub->add_option("--instanced", options->instanced,
                  "Control faces, about, of a scene of instances of 10,000 faces; 0: none")
      ->check(CLI::Range(std::size_t{0}, std::size_t{10000000000}))
      ->capture_default_str();
  add_size_option(*sub, options->size);
  add_runs_option(*sub, options->runs);
  add_report_option(*sub, options->report);
  sub->callback([options, &command] { command = [options] { return bench_scaling(*options); }; });
}

void add_lost(CLI::App& app, Command& command) {
  const auto options = std::make_shared<LostOptions>();
  CLI::App* sub = app.add_subcommand("lost",
                                     "Throw rays at models and count hits that chords lose or make up, in and outside "
                                     "of the band around outlines that "
                                     "their tolerance implies; exits with 1 if there are any outside");
  sub->add_option("MODEL", options->models, "OBJ files or scene files")->required();
  sub->add_option("--rays", options->rays,
                  "Rays at each model (as many at each of its instances, rounded up), in thirds: from cameras, "
                  "incoherent, grazing; a tenth in addition is aimed at "
                  "edges and vertices of patches")
      ->check(CLI::Range(std::size_t{1}, std::size_t{10000000000}))
      ->capture_default_str();
  add_seed_option(*sub, options->seed);
  sub->add_option("--epsilon", options->epsilon, "In units")->check(is_positive())->capture_default_str();
  add_chord_options(*sub, options->unit, options->min_size, options->max_size);
  sub->add_flag("--a3", options->a3, "A3 in place of ShaoLin");
  add_threads_option(*sub, options->threads);
  sub->callback([options, &command] { command = [options] { return bench_lost(*options); }; });
}

void add_closest_bench(CLI::App& app, Command& command) {
  const auto options = std::make_shared<ClosestBenchOptions>();
  CLI::App* sub = app.add_subcommand(
      "closest",
      "Closest points against brute force, exits with 1 if any is wrong, and their speed against CGAL's tree over "
      "triangles");
  sub->add_option("MODEL", options->models, "OBJ files of Loop or Catmull-Clark")->required();
  sub->add_option("--checked", options->checked, "Points of each model that brute force looks at, too")
      ->check(CLI::Range(std::size_t{0}, std::size_t{1000000000}))
      ->capture_default_str();
  sub->add_option("--queries", options->queries, "Points that are timed")
      ->check(CLI::Range(std::size_t{1}, std::size_t{100000000}))
      ->capture_default_str();
  sub->add_option("--error", options->error,
                  "Triangles are refined until their distances are off by less, in diagonals")
      ->check(is_positive())
      ->capture_default_str();
  sub->add_option("--triangles", options->most_triangles, "No more of them")
      ->check(CLI::Range(std::size_t{1}, std::size_t{100000000}))
      ->capture_default_str();
  add_runs_option(*sub, options->runs);
  add_seed_option(*sub, options->seed);
  add_threads_option(*sub, options->threads);
  sub->callback([options, &command] { command = [options] { return bench_closest(*options); }; });
}

void add_moved(CLI::App& app, Command& command) {
  const auto options = std::make_shared<MovedOptions>();
  CLI::App* sub = app.add_subcommand(
      "moved", "Errors where a model is far from the origin, tiny or huge: ours, Embree's and CGAL's");
  sub->add_option("MODEL", options->models, "OBJ files")->required();
  add_scheme_options(*sub, options->scheme);
  sub->add_option("--shifts", options->shifts, "By how many diagonals the model is moved, with commas in between")
      ->check(CLI::Range(0.0, 1e12))
      ->delimiter(',')
      ->capture_default_str();
  sub->add_option("--scales", options->scales, "How many times as large it becomes, with commas in between")
      ->check(CLI::Range(1e-30, 1e30))
      ->delimiter(',')
      ->capture_default_str();
  sub->add_option("--rays", options->rays, "Rays at each")
      ->check(CLI::Range(std::size_t{1}, std::size_t{100000000}))
      ->capture_default_str();
  sub->add_option("--exact-hits", options->exact_hits,
                  "Hits of the exact method that are held against the control mesh, refined in quadruple precision")
      ->check(CLI::Range(std::size_t{0}, std::size_t{1000000}))
      ->capture_default_str();
  sub->add_option("--level", options->level, "Of the others' triangles")
      ->check(CLI::Range(1, 10))
      ->capture_default_str();
  add_seed_option(*sub, options->seed);
  add_threads_option(*sub, options->threads);
  sub->callback([options, &command] { command = [options] { return bench_moved(*options); }; });
}

}  // namespace

void add_bench(CLI::App& app, Command& command) {
  CLI::App* sub = app.add_subcommand(
      "bench", "Measure ShaoLin by chords, A3, uniform triangles and the exact method against each other");
  sub->require_subcommand(1);
  add_paper(*sub, command);
  add_pareto(*sub, command);
  add_scaling(*sub, command);
  add_lost(*sub, command);
  add_closest_bench(*sub, command);
  add_moved(*sub, command);
}

}  // namespace shaolin
