#include "tools/bench/paper.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>

#include "schemes/errors.h"
#include "tools/bench/csv_tables.h"
#include "tools/bench/report_folder.h"
#include "tools/cli/command.h"
#include "tools/cli/csv.h"
#include "tools/cli/level_map.h"
#include "tools/cli/render_image.h"
#include "tools/cli/threads.h"

namespace shaolin {
namespace {

constexpr int first_memory_level = 3;  ///< of Table 4
constexpr int deepest_map_level = 7;   ///< where the colours of maps end

Contender adaptive(ContenderKind kind, const PaperScene& scene, double epsilon) {
  return {.kind = kind, .epsilon = epsilon, .chord = {epsilon * scene.unit, 2, scene.max_size}};
}

std::vector<Contender> contenders_of(const PaperScene& scene, int most_level) {
  std::vector<Contender> all{Contender{}};
  for (const ContenderKind kind : {ContenderKind::chord, ContenderKind::a3})
    for (const PaperLevels& row : scene.levels) all.push_back(adaptive(kind, scene, row.epsilon));
  for (const ContenderKind kind : {ContenderKind::uniform, ContenderKind::triangles})
    for (int level = 1; level <= most_level; ++level) all.push_back({.kind = kind, .level = level});
  return all;
}

MemoryFigures measure_memory(const PaperScene& scene, const Subject& subject, const Stage& stage,
                             const PaperOptions& options) {
  MemoryFigures figures;
  figures.shaolin = bytes_after(adaptive(ContenderKind::chord, scene, paper_epsilon), subject, stage);
  figures.a3 = bytes_after(adaptive(ContenderKind::a3, scene, paper_epsilon), subject, stage);
  for (int level = first_memory_level; level <= options.most_level; ++level) {
    const std::size_t before = figures.uniform.empty() ? 0 : figures.uniform.back().bytes;
    if (4 * before > options.measure.most_bytes)
      figures.uniform.push_back({4 * before, true});
    else
      figures.uniform.push_back({bytes_after({.kind = ContenderKind::uniform, .level = level}, subject, stage), false});
  }
  return figures;
}

MapLikeness compare_maps(const Image& a, const Image& b) {
  MapLikeness result;
  double sum = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    const Pixel &p = a.pixels[i], &q = b.pixels[i];
    result.one_only += p.hit() != q.hit();
    if (!p.hit() || !q.hit()) continue;
    const int difference = static_cast<int>(p.level) - static_cast<int>(q.level);
    ++result.both;
    result.equal += difference == 0;
    result.within_one += std::abs(difference) <= 1;
    sum += difference;
  }
  if (result.both > 0) result.mean_difference = sum / static_cast<double>(result.both);
  return result;
}

/// Writes a scene's picture and the two maps.
MapLikeness draw_maps(const PaperScene& scene, const Subject& subject, const PaperOptions& options) {
  const auto image_by = [&](const Contender& contender) {
    Stage stage = subject.stage;
    const SceneOptions by = scene_options(contender);
    return render_image(build_scene(stage, by), subject.view, subject.stage.scene.look, by);
  };
  const Image shaolin = image_by(adaptive(ContenderKind::chord, scene, paper_epsilon));
  const Image a3 = image_by(adaptive(ContenderKind::a3, scene, paper_epsilon));
  const auto save = [&](const std::string& what, const Picture& picture) {
    write_picture(options.report / picture_name(scene, what), picture);
  };
  save("picture", beauty_picture(shaolin));
  save("shaolin", level_map(shaolin, subject.view, deepest_map_level));
  save("a3", level_map(a3, subject.view, deepest_map_level));
  return compare_maps(shaolin, a3);
}

PaperResult measure_scene(const PaperScene& scene, const PaperOptions& options) {
  const std::string file = std::string(scene.file) + (options.quads ? "-catmark" : "") + ".json";
  std::printf("%s\n", scene.title);
  const Subject subject(load_stage({options.scenes / file, {}, {}}), options.size);
  make_report_folder(options.report);
  PaperResult result{.scene = &scene};
  result.primary = subject.work.primary.size();
  result.shadow = subject.work.shadow.size();
  result.diagonal = subject.diagonal;
  result.measurements = measure(subject, contenders_of(scene, options.most_level), options.measure);
  result.shared = measure_memory(scene, subject, subject.stage, options);
  result.alone = measure_memory(scene, subject, without_sharing(subject.stage), options);
  result.maps = draw_maps(scene, subject, options);
  return result;
}

/// scene,meshes,method,level,bytes,estimated: level is empty for ShaoLin and A3.
void write_memory_table(const std::filesystem::path& file, const std::vector<PaperResult>& results) {
  CsvWriter writer(file, "scene,meshes,method,level,bytes,estimated");
  const auto row = [&](const PaperResult& result, bool shared, const char* method, int level, std::size_t bytes,
                       bool estimated) {
    writer.field(result.scene->file).field(shared ? "shared" : "alone").field(method);
    if (level > 0)
      writer.field(level);
    else
      writer.empty();
    writer.field(static_cast<long long>(bytes)).field(estimated ? 1 : 0).end_row();
  };
  for (const PaperResult& result : results)
    for (const bool shared : {true, false}) {
      const MemoryFigures& figures = shared ? result.shared : result.alone;
      row(result, shared, "ShaoLin", 0, figures.shaolin, false);
      row(result, shared, "A3", 0, figures.a3, false);
      for (std::size_t i = 0; i < figures.uniform.size(); ++i)
        row(result, shared, "Uniform", first_memory_level + static_cast<int>(i), figures.uniform[i].bytes,
            figures.uniform[i].estimated);
    }
  writer.commit();
}

bool all_timed(const PaperResult& result) {
  return std::all_of(result.measurements.begin(), result.measurements.end(),
                     [](const Measurement& one) { return one.fault.empty(); });
}

}  // namespace

const Measurement* PaperResult::find(ContenderKind kind, double parameter) const {
  for (const Measurement& one : measurements)
    if (one.contender.kind == kind && one.contender.parameter() == parameter) return &one;
  return nullptr;
}

std::string picture_name(const PaperScene& scene, const std::string& what) {
  return std::string(scene.file) + "-" + what + ".png";
}

int bench_paper(const PaperOptions& options) {
  std::vector<PaperResult> results;
  run_with_threads(options.threads, [&] {
    for (const PaperScene& scene : paper_scenes())
      if (options.only.empty() || std::count(options.only.begin(), options.only.end(), scene.file) > 0)
        results.push_back(measure_scene(scene, options));
  });
  std::vector<NamedMeasurements> tables;
  for (const PaperResult& result : results) tables.push_back({result.scene->file, &result.measurements});
  write_level_table(options.report / "levels.csv", tables);
  write_time_table(options.report / "times.csv", tables);
  write_error_table(options.report / "errors.csv", tables);
  write_memory_table(options.report / "memory.csv", results);
  write_page(options.report / "paper.html", [&](std::ostream& out) { write_paper_page(out, results, options); });
  return std::all_of(results.begin(), results.end(), all_timed) ? exit_done : exit_check_failed;
}

}  // namespace shaolin
