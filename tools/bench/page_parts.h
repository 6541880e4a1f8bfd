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

/// All timed measurements of a kind: x of the measurement over seconds, with bars from least to most.
template <class X>
PlotSeries time_series(const std::vector<Measurement>& measurements, ContenderKind kind, X x) {
  PlotSeries series;
  for (const Measurement& one : measurements) {
    if (one.contender.kind != kind || one.seconds.empty()) continue;
    const Spread seconds = spread(one.seconds);
    series.name = one.contender.method();
    series.color = color_of(one.contender);
    series.points.push_back({x(one), seconds.median, seconds.least, seconds.most, ""});
  }
  series.dashed = kind == ContenderKind::embree;
  return series;
}

/// A line across the plot at a measurement's time.
PlotSeries time_line(const Measurement& measurement, const std::string& label);

/// Rows of all that was measured: errors, lost and ghost hits, time, memory.
void write_error_rows(std::ostream& out, const std::vector<Measurement>& measurements);

/// What stands in write_error_rows(), in words.
extern const char* const error_rows_note;

}  // namespace shaolin
