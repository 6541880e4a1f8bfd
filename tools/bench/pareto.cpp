#include "tools/bench/pareto.h"

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <utility>

#include "schemes/errors.h"
#include "tools/bench/csv_tables.h"
#include "tools/bench/embree_stage.h"
#include "tools/bench/paper_figures.h"
#include "tools/bench/peer_ratios.h"
#include "tools/bench/report_folder.h"
#include "tools/cli/command.h"
#include "tools/cli/csv.h"
#include "tools/cli/threads.h"

namespace shaolin {
namespace {

constexpr double epsilons[] = {0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5};

const PaperScene* paper_scene_of(const ModelOptions& model) {
  std::string stem = model.file.stem().string();
  if (const std::string quads = "-catmark"; stem.ends_with(quads)) stem.resize(stem.size() - quads.size());
  for (const PaperScene& scene : paper_scenes())
    if (is_scene_file(model.file) && stem == scene.file) return &scene;
  return nullptr;
}

bool is_chosen(const ParetoOptions& options, ContenderKind kind) {
  return kind == ContenderKind::exact || options.methods.empty() ||
         std::count(options.methods.begin(), options.methods.end(), name_of(kind)) > 0;
}

/// The peer next to the exact method, for turns are taken in this order.
std::vector<Contender> contenders_of(const ParetoOptions& options, const ParetoResult& scene) {
  std::vector<Contender> all;
  for (const ContenderKind kind : contender_kinds) {
    if (!is_chosen(options, kind) || (kind == ContenderKind::subdivision && !scene.left_out.empty())) continue;
    if (const Contender one{.kind = kind}; one.is_uniform())
      for (int level = 1; level <= options.most_level; ++level) all.push_back({.kind = kind, .level = level});
    else if (one.is_adaptive())
      for (const double epsilon : epsilons)
        all.push_back(
            {.kind = kind, .epsilon = epsilon, .chord = {epsilon * scene.unit, options.min_size, scene.max_size}});
    else
      all.push_back(one);
  }
  return all;
}

/// Empty if Embree's subdivision geometry knows all that the scene's meshes ask for.
std::string why_no_subdivision(const Stage& stage) {
  try {
    EmbreeStage(stage, 0, EmbreeSurface::subdivision);
    return {};
  } catch (const InputError& error) {
    return error.what();
  }
}

ModelOptions model_of(const ParetoOptions& options, const std::filesystem::path& file) {
  return {file, options.scheme.scheme, options.scheme.plugin};
}

void write_exact_table(const std::filesystem::path& file, const std::vector<ParetoResult>& results) {
  CsvWriter writer(file,
                   "scene,hits,position_median,position_p99,position_max,across_median,across_p99,across_max,"
                   "along_median,along_p99,along_max");
  for (const ParetoResult& result : results) {
    const ExactErrors& exact = result.exact;
    writer.field(result.scene).field(static_cast<long long>(exact.hits));
    for (const Quantiles* const of : {&exact.position, &exact.across, &exact.along})
      writer.field(of->median).field(of->p99).field(of->max);
    writer.end_row();
  }
  writer.commit();
}

ParetoResult measure_scene(const ParetoOptions& options, const ModelOptions& model, Stage stage) {
  const Subject subject(std::move(stage), options.size, WarmRays::random_and_ambient_too);
  ParetoResult result{.scene = model.file.stem().string()};
  std::printf("%s\n", result.scene.c_str());
  result.diagonal = subject.diagonal;
  result.unit = options.unit.value_or(unit_of(model, subject.diagonal));
  result.max_size = std::max(options.min_size, options.max_size.value_or(max_size_of(model)));
  result.primary = subject.work.primary.size();
  result.shadow = subject.work.shadow.size();
  result.random = subject.work.random.size();
  result.ambient = subject.work.ambient.size();
  if (is_chosen(options, ContenderKind::subdivision)) result.left_out = why_no_subdivision(subject.stage);
  if (!result.left_out.empty()) std::printf("  Embree's subdivision is left out: %s\n", result.left_out.c_str());
  result.measurements = measure(subject, contenders_of(options, result), options.measure);
  result.exact = exact_errors(subject.stage, subject.exact, subject.work.primary, options.exact_hits);
  if (result.exact.hits > 0)
    std::printf("  exact, %zu hits against refinement in 113 bits: off by %.2g at most\n", result.exact.hits,
                result.exact.position.max);
  return result;
}

void write_report(const ParetoOptions& options, const std::vector<ParetoResult>& results) {
  std::vector<NamedMeasurements> tables;
  for (const ParetoResult& result : results) tables.push_back({result.scene, &result.measurements});
  write_time_table(options.report / "times.csv", tables);
  write_error_table(options.report / "errors.csv", tables);
  write_exact_table(options.report / "exact.csv", results);
  write_page(options.report / "pareto.json", [&](std::ostream& out) { write_pareto_json(out, results, options); });
  write_page(options.report / "pareto.html", [&](std::ostream& out) { write_pareto_page(out, results, options); });
}

}  // namespace

double unit_of(const ModelOptions& model, double diagonal) {
  const PaperScene* const scene = paper_scene_of(model);
  return scene != nullptr ? scene->unit : diagonal / 50;
}

double max_size_of(const ModelOptions& model) {
  const PaperScene* const scene = paper_scene_of(model);
  return scene != nullptr ? scene->max_size : ChordOptions{}.max_size;
}

int bench_pareto(const ParetoOptions& options) {
  int status = exit_done;
  run_with_threads(options.threads, [&] {
    std::vector<Stage> stages;
    for (const auto& file : options.files) stages.push_back(load_stage(model_of(options, file)));
    make_report_folder(options.report);
    std::vector<ParetoResult> results;
    for (std::size_t i = 0; i < stages.size(); ++i)
      results.push_back(measure_scene(options, model_of(options, options.files[i]), std::move(stages[i])));
    write_report(options, results);
    if (const TextTable bars = bar_table(results); !bars.rows.empty()) {
      std::cout << bar_note << '\n';
      write_markdown(std::cout, bars);
    }
    for (const ParetoResult& result : results)
      for (const Measurement& one : result.measurements)
        if (!one.fault.empty()) status = exit_check_failed;
  });
  return status;
}

}  // namespace shaolin
