#include <functional>

#include "tools/bench/page_parts.h"
#include "tools/bench/pareto.h"
#include "tools/cli/html.h"

namespace shaolin {
namespace {

constexpr ContenderKind plotted_kinds[] = {ContenderKind::chord, ContenderKind::a3, ContenderKind::uniform,
                                           ContenderKind::embree, ContenderKind::subdivision};

/// One of the quantiles of one of the errors.
struct ErrorAxis {
  const char* name;
  Quantiles ErrorFigures::*error;
  double Quantiles::*quantile;

  double operator()(const Measurement& one) const { return one.errors.*error.*quantile; }
};
constexpr ErrorAxis p99{"distance along the ray, 99th percentile, in the scene's unit", &ErrorFigures::distance,
                        &Quantiles::p99};
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
    if (phase != Phase::build && any) write_plot(out, result, cost_of(phase), p99);
  }
  write_plot(out, result, memory(), p99);
  for (const ErrorAxis& error : {median, angle}) write_plot(out, result, cost_of(Phase::cold), error);
}

/// The exact method's times over those of Embree, by phase.
void write_ratios(std::ostream& out, const ParetoResult& result) {
  const Measurement& exact = result.measurements.front();
  if (!exact.is_timed()) return;
  out << "<h3>The exact method's time over the peer's</h3>\n<table><tr><th>peer";
  for (const Phase phase : phases) out << "<th class=n>" << name_of(phase);
  out << "</tr>\n";
  for (const Measurement& one : result.measurements) {
    if (!one.contender.is_embree() || !one.is_timed()) continue;
    out << "<tr><td>" << one.contender.name();
    for (const Phase phase : phases)
      out << "<td class=n>" << (one.is_timed(phase) ? to_text(ratio(exact, one, phase)) : "");
    out << "</tr>\n";
  }
  out << "</table>\n<p>Run by run: median, least to most. Below 1 the exact method is the faster one.</p>\n";
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
  write_error_rows(out, result.measurements);
  for (const Measurement& one : result.measurements)
    if (!one.fault.empty())
      out << "<p class=FAIL>" << one.contender.name() << " was not timed: " << html_escaped(one.fault) << ".</p>\n";
}

}  // namespace

void write_pareto_page(std::ostream& out, const std::vector<ParetoResult>& results, const ParetoOptions& options) {
  out << html_head("shaolin bench pareto", "Time and memory against error") << "<p>" << options.size.width << "x"
      << options.size.height << " pixels, one thread; " << options.measure.runs
      << " runs in turns, medians with bars from least to most; minSize " << options.min_size
      << " pixels. Points carry their epsilon or level. Left and below is better. The exact method is what errors are "
         "measured from: its line is its time, with its own error at the end. Files: <a href=pareto.json>all in "
         "JSON</a>, <a href=times.csv>times</a>, <a href=errors.csv>errors</a>, <a href=exact.csv>the exact method's "
         "errors</a>.</p>\n";
  for (const ParetoResult& result : results) write_scene(out, result);
  out << "<h2>What the tables hold</h2>\n<p>" << time_rows_note << "</p>\n<p>" << error_rows_note
      << " The normals of Embree's subdivision are its facets'.</p>\n</html>\n";
}

}  // namespace shaolin
