#include "tools/bench/pareto.h"

#include <algorithm>
#include <cstdio>
#include <iterator>

#include "tools/bench/csv_tables.h"
#include "tools/bench/exact_errors.h"
#include "tools/bench/page_parts.h"
#include "tools/bench/paper_figures.h"
#include "tools/bench/report_folder.h"
#include "tools/cli/command.h"
#include "tools/cli/csv.h"
#include "tools/cli/html.h"
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

std::vector<Contender> contenders_of(const ParetoOptions& options, double unit, double max_size) {
  std::vector<Contender> all{Contender{}};
  for (const ContenderKind kind : {ContenderKind::chord, ContenderKind::a3})
    for (const double epsilon : epsilons)
      all.push_back({.kind = kind, .epsilon = epsilon, .chord = {epsilon * unit, options.min_size, max_size}});
  for (const ContenderKind kind : {ContenderKind::uniform, ContenderKind::embree})
    for (int level = 1; level <= options.most_level; ++level) all.push_back({.kind = kind, .level = level});
  return all;
}

/// One of the quantiles of one of the errors.
struct Axis {
  const char* name;
  Quantiles ErrorFigures::*error;
  double Quantiles::*quantile;
};
constexpr Axis axes[] = {
    {"distance along the ray, 99th percentile, in the scene's unit", &ErrorFigures::distance, &Quantiles::p99},
    {"distance along the ray, median, in the scene's unit", &ErrorFigures::distance, &Quantiles::median},
    {"angle of the normal, 99th percentile, rad", &ErrorFigures::normal, &Quantiles::p99},
};

void write_plot(std::ostream& out, const std::vector<Measurement>& measurements, const Axis& axis,
                const ExactErrors& exact) {
  Plot plot{.x_label = axis.name, .y_label = "time, s"};
  for (const ContenderKind kind :
       {ContenderKind::chord, ContenderKind::a3, ContenderKind::uniform, ContenderKind::embree}) {
    PlotSeries series =
        time_series(measurements, kind, [&](const Measurement& one) { return one.errors.*axis.error.*axis.quantile; });
    auto point = series.points.begin();
    for (const Measurement& one : measurements)
      if (one.contender.kind == kind && !one.seconds.empty()) point++->label = digits(one.contender.parameter());
    plot.series.push_back(series);
  }
  for (const Measurement& one : measurements)
    if (one.contender.kind == ContenderKind::exact && !one.seconds.empty())
      plot.series.push_back(time_line(one, axis.error == &ErrorFigures::distance && exact.hits > 0
                                               ? digits(exact.along.*axis.quantile, 2)
                                               : "exact"));
  out << "<figure>";
  write_svg(out, plot);
  out << "<figcaption>time against " << axis.name << "</figcaption></figure>\n";
}

std::string exact_row(const std::string& name, const Quantiles& of) {
  std::string row = "<tr><td>" + name;
  for (const double value : {of.median, of.p99, of.max}) row += "<td class=n>" + digits(value, 2);
  return row + "</tr>\n";
}

void write_exact_table(const std::filesystem::path& file, const ExactErrors& exact) {
  CsvWriter writer(file,
                   "hits,position_median,position_p99,position_max,across_median,across_p99,across_max,along_median,"
                   "along_p99,along_max");
  writer.field(static_cast<long long>(exact.hits));
  for (const Quantiles* const of : {&exact.position, &exact.across, &exact.along})
    writer.field(of->median).field(of->p99).field(of->max);
  writer.end_row();
  writer.commit();
}

void write_pareto_page(std::ostream& out, const ParetoOptions& options, const Subject& subject, double unit,
                       double max_size, const std::vector<Measurement>& measurements, const ExactErrors& exact) {
  const std::string model = options.model.file.filename().string();
  out << html_head("shaolin bench pareto " + model, "Time against error: " + model) << "<p>" << options.size.width
      << "x" << options.size.height << " pixels, " << subject.work.primary.size() << " primary and "
      << subject.work.shadow.size() << " shadow rays, one thread, cold; " << options.measure.runs
      << " runs in turns, medians with bars from least to most. Epsilon in units of " << digits(unit, 6)
      << " (the scene's diagonal is " << digits(subject.diagonal, 6) << "); minSize " << options.min_size
      << ", maxSize " << max_size
      << " pixels. Points carry their epsilon or level. Left and below is better. The exact method is what errors are "
         "measured from: its line is its time, with its own error at the end. CSV: <a href=times.csv>times</a>, <a "
         "href=errors.csv>errors</a>.</p>\n";
  for (const Axis& axis : axes) write_plot(out, measurements, axis, exact);
  if (exact.hits > 0)
    out << "<p>" << exact.hits
        << " hits of the exact method against the control mesh refined in numbers of 113 bits, at the parameters that "
           "they "
           "tell; lengths of the scene's: median, 99th percentile, maximum.</p>\n<table>"
        << exact_row("from the hit's position to the surface", exact.position)
        << exact_row("from the surface's point to the ray", exact.across) << exact_row("along the ray", exact.along)
        << "</table>\n";
  write_error_rows(out, measurements);
  out << "<p>" << error_rows_note << "</p>\n</html>\n";
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
    const Subject subject(options.model, options.size);
    make_report_folder(options.report);
    const double unit = options.unit.value_or(unit_of(options.model, subject.diagonal));
    const double max_size = std::max(options.min_size, options.max_size.value_or(max_size_of(options.model)));
    const std::vector<Measurement> measurements =
        measure(subject, contenders_of(options, unit, max_size), options.measure);
    const ExactErrors exact = exact_errors(subject.stage, subject.exact, subject.work.primary, options.exact_hits);
    if (exact.hits > 0)
      std::printf("  exact, %zu hits against refinement in 113 bits: off by %.2g at most\n", exact.hits,
                  exact.position.max);
    const std::vector<NamedMeasurements> tables{{options.model.file.stem().string(), &measurements}};
    write_time_table(options.report / "times.csv", tables);
    write_error_table(options.report / "errors.csv", tables);
    write_exact_table(options.report / "exact.csv", exact);
    write_page(options.report / "pareto.html", [&](std::ostream& out) {
      write_pareto_page(out, options, subject, unit, max_size, measurements, exact);
    });
    for (const Measurement& one : measurements)
      if (!one.fault.empty()) status = exit_check_failed;
  });
  return status;
}

}  // namespace shaolin
