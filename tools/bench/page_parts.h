#pragma once
/// Numbers, series and tables of the bench's pages.
#include <ostream>
#include <string>
#include <vector>

#include "tools/bench/measure.h"
#include "tools/bench/plot.h"

namespace shaolin {

/// printf's %g with so many significant digits.
std::string digits(double value, int significant = 3);

/// "1.23 (1.20 to 1.31)".
std::string to_text(const Spread& spread);

/// "83 MB", as 10^6 bytes.
std::string megabytes(std::size_t bytes);

/// The colour of a method in all plots; uniform levels from light to dark.
std::string color_of(const Contender& contender);

/// All timed measurements of a kind: x(measurement) over the Spread y(measurement), with bars from least to most.
template <class X, class Y>
PlotSeries series_of(const std::vector<Measurement>& measurements, ContenderKind kind, X x, Y y) {
  PlotSeries series;
  for (const Measurement& one : measurements) {
    if (one.contender.kind != kind || !one.is_timed()) continue;
    const Spread shown = y(one);
    series.name = one.contender.method();
    series.color = color_of(one.contender);
    series.points.push_back({x(one), shown.median, shown.least, shown.most, ""});
  }
  series.dashed = Contender{.kind = kind}.is_embree();
  return series;
}

/// A line across the plot at a measurement's y.
PlotSeries line_of(const Measurement& measurement, const Spread& y, const std::string& label);

/// Rows of times by phase, of those phases that any was timed in, and of memory.
void write_time_rows(std::ostream& out, const std::vector<Measurement>& measurements);

/// Rows of errors, lost and ghost hits, of primary and shadow rays or of random ones.
void write_error_rows(std::ostream& out, const std::vector<Measurement>& measurements,
                      ErrorFigures Measurement::*rays = &Measurement::errors);

/// Rows of lost and ghost hits of ambient occlusion.
void write_hit_rows(std::ostream& out, const std::vector<Measurement>& measurements);

/// What stands in those rows, in words.
extern const char* const time_rows_note;
extern const char* const error_rows_note;

}  // namespace shaolin
