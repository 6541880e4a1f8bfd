#include "tools/bench/plot.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "tools/bench/plot_labels.h"
#include "tools/cli/html.h"

namespace shaolin {
namespace {

constexpr double width = 780, height = 430, left = 74, right = 270, top = 14, bottom = 52;
constexpr double font_size = 12;
constexpr double plot_right = width - right, plot_bottom = height - bottom;

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

/// A logarithmic axis from `from` to `to` in pixels.
class Axis {
 public:
  Axis(double from, double to) : from_(from), to_(to) {}

  void add(double value) {
    if (!(value > 0) || !std::isfinite(value)) return;
    low_ = std::min(low_, std::log10(value));
    high_ = std::max(high_, std::log10(value));
  }
  /// Leaves a margin on both sides. An axis without values is from 1 to 10.
  void close() {
    if (!(low_ <= high_)) low_ = 0, high_ = 1;
    const double margin = std::max(0.06 * (high_ - low_), 0.1);
    low_ -= margin;
    high_ += margin;
  }
  double at(double value) const { return from_ + (to_ - from_) * (std::log10(value) - low_) / (high_ - low_); }

  /// Powers of ten; 2 and 5 times them, too, where there are few.
  std::vector<double> ticks() const {
    std::vector<double> result;
    const bool narrow = high_ - low_ < 3;
    const int step = std::max(1, static_cast<int>((high_ - low_) / 8));
    for (int exponent = static_cast<int>(std::floor(low_)); exponent <= high_; exponent += step)
      for (const double digit : {1.0, 2.0, 5.0}) {
        const double tick = digit * std::pow(10.0, exponent);
        if ((digit == 1 || narrow) && std::log10(tick) >= low_ && std::log10(tick) <= high_) result.push_back(tick);
      }
    return result;
  }

 private:
  double from_, to_;
  double low_ = std::numeric_limits<double>::infinity(), high_ = -low_;
};

void write_line(std::ostream& out, double x1, double y1, double x2, double y2, const std::string& style) {
  out << "<line x1='" << x1 << "' y1='" << y1 << "' x2='" << x2 << "' y2='" << y2 << "' " << style << "/>\n";
}

void write_text(std::ostream& out, double x, double y, const std::string& text, const std::string& style = "") {
  out << "<text x='" << x << "' y='" << y << "' " << style << '>' << html_escaped(text) << "</text>\n";
}

void write_axes(std::ostream& out, const Plot& plot, const Axis& x, const Axis& y) {
  for (const double tick : y.ticks()) {
    write_line(out, left, y.at(tick), plot_right, y.at(tick), "stroke='#e3e3e3'");
    write_text(out, left - 7, y.at(tick) + 4, number(tick), "text-anchor='end'");
  }
  for (const double tick : plot.x_ticks.empty() ? x.ticks() : plot.x_ticks) {
    write_line(out, x.at(tick), top, x.at(tick), plot_bottom, "stroke='#e3e3e3'");
    write_text(out, x.at(tick), plot_bottom + 17, number(tick), "text-anchor='middle'");
  }
  out << "<rect x='" << left << "' y='" << top << "' width='" << plot_right - left << "' height='" << plot_bottom - top
      << "' fill='none' stroke='#888'/>\n";
  write_text(out, (left + plot_right) / 2, height - 14, plot.x_label, "text-anchor='middle'");
  write_text(out, -(top + plot_bottom) / 2, 16, plot.y_label, "text-anchor='middle' transform='rotate(-90)'");
}

void write_series(std::ostream& out, const PlotSeries& series, const Axis& x, const Axis& y) {
  const std::string stroke = "stroke='" + series.color + "'" + (series.dashed ? " stroke-dasharray='6 4'" : "");
  if (series.level_line) {
    const PlotPoint& point = series.points.front();
    write_line(out, left, y.at(point.y), plot_right, y.at(point.y), stroke + " stroke-width='1.4'");
    if (point.high > 0) write_line(out, plot_right - 4, y.at(point.low), plot_right - 4, y.at(point.high), stroke);
    return;
  }
  out << "<polyline fill='none' stroke-width='1.8' " << stroke << " points='";
  for (const PlotPoint& point : series.points)
    if (point.x > 0 && point.y > 0) out << x.at(point.x) << ',' << y.at(point.y) << ' ';
  out << "'/>\n";
  for (const PlotPoint& point : series.points) {
    if (!(point.x > 0 && point.y > 0)) continue;
    const double at = x.at(point.x);
    if (point.high > 0) {
      write_line(out, at, y.at(point.low), at, y.at(point.high), "stroke='" + series.color + "'");
      for (const double end : {point.low, point.high})
        write_line(out, at - 3, y.at(end), at + 3, y.at(end), "stroke='" + series.color + "'");
    }
    out << "<circle cx='" << at << "' cy='" << y.at(point.y) << "' r='" << PointLabels::radius << "' fill='"
        << series.color << "'/>\n";
  }
}

void write_point_labels(std::ostream& out, const Plot& plot, const Axis& x, const Axis& y) {
  PointLabels labels;
  const auto for_each_point = [&](const auto& use) {
    for (const PlotSeries& series : plot.series)
      for (const PlotPoint& point : series.points)
        if (!series.level_line && point.x > 0 && point.y > 0) use(series, point);
  };
  for_each_point([&](const PlotSeries&, const PlotPoint& point) { labels.add_mark(x.at(point.x), y.at(point.y)); });
  for_each_point([&](const PlotSeries& series, const PlotPoint& point) {
    if (point.label.empty()) return;
    if (const auto place = labels.place(x.at(point.x), y.at(point.y), point.label.size()))
      write_text(out, place->x, place->y, point.label,
                 "font-size='" + number(PointLabels::font_size) + "' fill='" + series.color + "'");
  });
}

/// Dashed lines' labels stand in a column of their own, as they run close to the others.
void write_line_labels(std::ostream& out, const Plot& plot, const Axis& y) {
  for (const bool dashed : {false, true}) {
    std::vector<const PlotSeries*> lines;
    for (const PlotSeries& series : plot.series)
      if (series.level_line && series.dashed == dashed) lines.push_back(&series);
    const auto height_of = [&](const PlotSeries* line) { return y.at(line->points.front().y) + 4; };
    std::stable_sort(lines.begin(), lines.end(),
                     [&](const auto* a, const auto* b) { return height_of(a) < height_of(b); });
    std::vector<double> wanted;
    for (const PlotSeries* const line : lines) wanted.push_back(height_of(line));
    const std::vector<double> heights = moved_apart(wanted, font_size);
    for (std::size_t i = 0; i < lines.size(); ++i)
      write_text(out, plot_right + (dashed ? 56 : 5), heights[i], lines[i]->points.front().label,
                 "fill='" + lines[i]->color + "'");
  }
}

void write_legend(std::ostream& out, const Plot& plot) {
  std::vector<std::string> named;
  for (const PlotSeries& series : plot.series) {
    if (std::find(named.begin(), named.end(), series.name) != named.end()) continue;
    const double y = top + 12 + 18 * static_cast<double>(named.size());
    named.push_back(series.name);
    write_line(out, plot_right + 108, y - 4, plot_right + 134, y - 4,
               "stroke-width='2' stroke='" + series.color + "'" + (series.dashed ? " stroke-dasharray='6 4'" : ""));
    write_text(out, plot_right + 140, y, series.name);
  }
}

}  // namespace

void write_svg(std::ostream& out, const Plot& plot) {
  Axis x(left, plot_right), y(plot_bottom, top);
  for (const double tick : plot.x_ticks) x.add(tick);
  for (const PlotSeries& series : plot.series)
    for (const PlotPoint& point : series.points) {
      if (!series.level_line) x.add(point.x);
      for (const double value : {point.y, point.low, point.high}) y.add(value);
    }
  x.close();
  y.close();
  out << "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 " << width << ' ' << height << "' width='" << width
      << "' height='" << height << "' font-size='" << font_size << "' font-family='sans-serif'>\n";
  write_axes(out, plot, x, y);
  for (const PlotSeries& series : plot.series)
    if (!series.points.empty()) write_series(out, series, x, y);
  write_point_labels(out, plot, x, y);
  write_line_labels(out, plot, y);
  write_legend(out, plot);
  out << "</svg>\n";
}

}  // namespace shaolin
