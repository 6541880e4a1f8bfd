#include <functional>

#include "tools/bench/page_parts.h"
#include "tools/bench/peer_ratios.h"
#include "tools/bench/turns.h"
#include "tools/cli/html.h"

namespace shaolin {
namespace {

constexpr ContenderKind plotted_kinds[] = {ContenderKind::chord, ContenderKind::a3, ContenderKind::uniform,
                                           ContenderKind::triangles, ContenderKind::subdivision};

/// One of the quantiles of one of the errors of the picture's, or of random, rays.
struct ErrorAxis {
  const char* name;
  Quantiles ErrorFigures::*error;
  double Quantiles::*quantile;
  ErrorFigures Measurement::*rays = &Measurement::errors;

  double operator()(const Measurement& one) const { return one.*rays.*error.*quantile; }
};
constexpr ErrorAxis p99{"distance along the ray, 99th percentile, in the scene's unit", &ErrorFigures::distance,
                        &Quantiles::p99};
constexpr ErrorAxis random_p99{"distance along random rays, 99th percentile, in the scene's unit",
                               &ErrorFigures::distance, &Quantiles::p99, &Measurement::random_errors};
constexpr ErrorAxis median{"distance along the ray, median, in the scene's unit", &ErrorFigures::distance,
                           &Quantiles::median};
constexpr ErrorAxis angle{"angle of the normal, 99th percentile, rad", &ErrorFigures::normal, &Quantiles::p99};

/// What errors cost.
struct CostAxis {
  std::string name, unit;
  std::function<Spread(const Measurement&)> of;
};

CostAxis cost_of(Phase phase) {
  return {std::string("time: ") + name_of(phase), "s",
          [phase](const Measurement& one) { return spread(one.times(phase)); }};
}

CostAxis memory() {
  return {"memory", "MB", [](const Measurement& one) {
            const double megabytes = static_cast<double>(one.bytes) / 1e6;
            return Spread{megabytes, megabytes, megabytes};
          }};
}

void write_plot(std::ostream& out, const ParetoResult& result, const CostAxis& cost, const ErrorAxis& error) {
  Plot plot{.x_label = error.name, .y_label = cost.name + ", " + cost.unit};
  for (const ContenderKind kind : plotted_kinds) {
    PlotSeries series = series_of(result.measurements, kind, error, cost.of);
    if (series.points.empty()) continue;
    auto point = series.points.begin();
    for (const Measurement& one : result.measurements)
      if (one.contender.kind == kind && one.is_timed()) point++->label = digits(one.contender.parameter());
    plot.series.push_back(series);
  }
  for (const Measurement& one : result.measurements)
    if (one.contender.kind == ContenderKind::exact && one.is_timed())
      plot.series.push_back(line_of(one, cost.of(one),
                                    error.error == &ErrorFigures::distance && result.exact.hits > 0
                                        ? digits(result.exact.along.*error.quantile, 2)
                                        : "exact"));
  out << "<figure>";
  write_svg(out, plot);
  out << "<figcaption>" << cost.name << " against " << error.name << "</figcaption></figure>\n";
}

void write_plots(std::ostream& out, const ParetoResult& result) {
  for (const Phase phase : phases) {
    const bool any = result.ambient > 0 || phase != Phase::ambient;
    if (phase != Phase::tessellation && phase != Phase::build && any)
      write_plot(out, result, cost_of(phase), phase == Phase::random ? random_p99 : p99);
  }
  write_plot(out, result, memory(), p99);
  for (const ErrorAxis& error : {median, angle}) write_plot(out, result, cost_of(Phase::cold), error);
}

void write_ratios(std::ostream& out, const ParetoResult& result) {
  const TextTable ratios = ratio_table(result);
  if (ratios.rows.empty()) return;
  out << "<h3>The exact method over Embree, all levels</h3>\n";
  write_html(out, ratios);
}

void write_bars(std::ostream& out, const std::vector<ParetoResult>& results) {
  const TextTable bars = bar_table(results);
  if (bars.rows.empty()) return;
  out << "<h2>The exact method over Embree</h2>\n<p>" << bar_note << "</p>\n";
  write_html(out, bars);
}

std::string exact_row(const std::string& name, const Quantiles& of) {
  std::string row = "<tr><td>" + name;
  for (const double value : {of.median, of.p99, of.max}) row += "<td class=n>" + digits(value, 2);
  return row + "</tr>\n";
}

void write_exact_errors(std::ostream& out, const ExactErrors& exact) {
  if (exact.hits == 0) return;
  out << "<p>" << exact.hits
      << " hits of the exact method against the control mesh refined in numbers of 113 bits, at the parameters that "
         "they tell; lengths of the scene's: median, 99th percentile, maximum.</p>\n<table>"
      << exact_row("from the hit's position to the surface", exact.position)
      << exact_row("from the surface's point to the ray", exact.across) << exact_row("along the ray", exact.along)
      << "</table>\n";
}

void write_scene(std::ostream& out, const ParetoResult& result) {
  out << "<h2>" << html_escaped(result.scene) << "</h2>\n<p>" << result.primary << " primary, " << result.shadow
      << " shadow, " << result.random << " random and " << result.ambient
      << " ambient-occlusion rays. Epsilon in units of " << digits(result.unit, 6) << " (the scene's diagonal is "
      << digits(result.diagonal, 6) << "); maxSize " << result.max_size << " pixels.</p>\n";
  if (!result.left_out.empty())
    out << "<p>Embree's subdivision is left out: " << html_escaped(result.left_out) << ".</p>\n";
  write_plots(out, result);
  write_ratios(out, result);
  out << "<h3>Times and memory</h3>\n";
  write_time_rows(out, result.measurements);
  out << "<h3>Errors</h3>\n";
  write_exact_errors(out, result.exact);
  out << "<h4>Camera and shadow rays</h4>\n";
  write_error_rows(out, result.measurements);
  out << "<h4>Random rays</h4>\n";
  write_error_rows(out, result.measurements, &Measurement::random_errors);
  if (result.ambient > 0) {
    out << "<h4>Rays of ambient occlusion</h4>\n";
    write_hit_rows(out, result.measurements);
  }
  for (const Measurement& one : result.measurements)
    if (!one.fault.empty())
      out << "<p class=FAIL>" << one.contender.name() << " was not timed: " << html_escaped(one.fault) << ".</p>\n";
}

}  // namespace

void write_pareto_page(std::ostream& out, const std::vector<ParetoResult>& results, const ParetoOptions& options) {
  out << html_head("shaolin bench pareto", "Time and memory against error") << "<p>" << options.size.width << "x"
      << options.size.height << " pixels, one thread's processor time; " << options.measure.runs
      << " runs, warm rays in turns of " << chunk_rays << ", medians with bars from least to most; minSize "
      << options.min_size
      << " pixels. Points carry their epsilon or level. Left and below is better. The exact method is what errors are "
         "measured from: its line is its time, with its own error at the end. Files: <a href=pareto.json>all in "
         "JSON</a>, <a href=times.csv>times</a>, <a href=errors.csv>errors</a>, <a href=exact.csv>the exact method's "
         "errors</a>.</p>\n";
  write_bars(out, results);
  for (const ParetoResult& result : results) write_scene(out, result);
  out << "<h2>What the tables hold</h2>\n<p>" << time_rows_note << "</p>\n<p>" << error_rows_note
      << " The normals of Embree's subdivision are its facets'.</p>\n</html>\n";
}

}  // namespace shaolin
