#include "tools/bench/page_parts.h"
#include "tools/bench/plot.h"
#include "tools/bench/scaling.h"
#include "tools/cli/html.h"

namespace shaolin {
namespace {

PlotSeries series_of(const std::vector<ScalingResult>& results, const std::string& name, const std::string& color,
                     bool dashed, const auto& values) {
  PlotSeries series{.name = name, .color = color, .dashed = dashed};
  for (const ScalingResult& result : results) {
    if (result.instances > 1 || values(result).empty()) continue;
    const Spread shown = spread(values(result));
    series.points.push_back({static_cast<double>(result.faces), shown.median, shown.least, shown.most, ""});
  }
  return series;
}

void write_plot(std::ostream& out, const std::vector<ScalingResult>& results) {
  Plot plot{.x_label = "control faces", .y_label = "time, s"};
  plot.series.push_back(series_of(results, "reading", "#777", true, [](const auto& one) { return one.read; }));
  plot.series.push_back(series_of(results, "build", "#222", false, [](const auto& one) { return one.build; }));
  plot.series.push_back(
      series_of(results, "first image", "#1f6feb", false, [](const auto& one) { return one.cold[0]; }));
  plot.series.push_back(
      series_of(results, "two threads", "#1f6feb", true, [](const auto& one) { return one.cold[1]; }));
  plot.series.push_back(series_of(results, "once more", "#d9730d", false, [](const auto& one) { return one.warm[0]; }));
  plot.series.push_back(
      series_of(results, "two threads once more", "#d9730d", true, [](const auto& one) { return one.warm[1]; }));
  out << "<figure>";
  write_svg(out, plot);
  out << "<figcaption>Time against control faces</figcaption></figure>\n";
}

/// Run by run: how many times as fast as the first the second is.
std::string speed_up(const std::vector<double>& one, const std::vector<double>& two) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < one.size(); ++i) ratios.push_back(one[i] / two[i]);
  return to_text(spread(ratios));
}

void write_row(std::ostream& out, const ScalingResult& result) {
  out << "<tr><td>" << result.scene << "<td class=n>" << result.faces << "<td class=n>" << result.instances;
  if (!result.fault.empty()) {
    out << "<td class=FAIL colspan=10>" << html_escaped(result.fault) << "</tr>\n";
    return;
  }
  const double faces = static_cast<double>(result.faces), build = spread(result.build).median;
  out << "<td class=n>" << (result.read.empty() ? "" : digits(spread(result.read).median)) << "<td class=n>"
      << digits(build) << "<td class=n>" << digits(build / faces * 1e6) << "<td class=n>"
      << digits(spread(result.bytes).median / faces) << "<td class=n>" << digits(spread(result.cold[0]).median)
      << "<td class=n>" << speed_up(result.cold[0], result.cold[1]) << "<td class=n>"
      << digits(spread(result.warm[0]).median) << "<td class=n>" << speed_up(result.warm[0], result.warm[1])
      << "<td class=n>" << result.faces_touched << "<td class=n>" << megabytes(result.bytes_refined) << "</tr>\n";
}

}  // namespace

void write_scaling_page(std::ostream& out, const std::vector<ScalingResult>& results, const ScalingOptions& options) {
  out << html_head("shaolin bench scaling", "Cost against the size of the control mesh") << "<p>Bumpy tori of quads, "
      << options.size.width << "x" << options.size.height << " camera rays, " << options.runs
      << " runs in turns, medians. <a href=scaling.csv>The table as CSV</a>.</p>\n";
  write_plot(out, results);
  out << "<table><tr><th>scene<th>control faces<th>instances<th>read, s<th>build, s<th>build a face, &micro;s<th>heap "
         "a face, bytes<th>first image, s<th>two threads faster by<th>once more, s<th>two threads faster by<th>faces "
         "touched<th>refined</tr>\n";
  for (const ScalingResult& result : results) write_row(out, result);
  out << "</table>\n<p>Read: the OBJ file. Build: from the mesh in memory to a scene that has met no ray, so that this "
         "and "
         "the heap are what a face costs that none meets. The first image: rays alone; refined is what it leaves "
         "behind, beside tables that configurations share.</p>\n</html>\n";
}

}  // namespace shaolin
