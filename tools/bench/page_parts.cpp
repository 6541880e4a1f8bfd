#include "tools/bench/page_parts.h"

#include <algorithm>
#include <cstdio>

namespace shaolin {

const char* const time_rows_note =
    "Build: from meshes in memory to a scene. Cold: that and the first image, its primary and shadow rays. Then what "
    "is "
    "there already is asked again: camera and shadow rays are the image's; random rays are incoherent; ambient rays "
    "are "
    "short, as of ambient occlusion. Medians, least to most. Memory: bytes held by patches, or by triangles and their "
    "hierarchy, after all rays; peak: by how much resident memory rose at most, other things and what is freed again "
    "included.";

const char* const error_rows_note =
    "Errors are held against the exact method "
    "over all primary and shadow rays where both hit: the distance along the "
    "ray between the hits, in the scene's unit of length, and the angle between the normals. Lost: only the exact "
    "method hits; ghosts: only the other does. Farther and nearer: both hit, further apart than the band is wide. "
    "Outside: those of them that no exact ray explains that runs beside this one, within the band's width of 2 "
    "max(epsilon, min size &times; pixel at the hit). For triangles no band is known.";

std::string digits(double value, int significant) {
  char text[48];
  std::snprintf(text, sizeof text, "%.*g", significant, value);
  return text;
}

std::string to_text(const Spread& spread) {
  return digits(spread.median) + " (" + digits(spread.least) + " to " + digits(spread.most) + ")";
}

std::string megabytes(std::size_t bytes) {
  return digits(static_cast<double>(bytes) / 1e6, bytes < 1e8 ? 3 : 4) + " MB";
}

std::string color_of(const Contender& contender) {
  switch (contender.kind) {
    case ContenderKind::chord:
      return "#1f6feb";
    case ContenderKind::a3:
      return "#d9730d";
    case ContenderKind::exact:
      return "#111";
    case ContenderKind::uniform:
      return "#4b8b3b";
    case ContenderKind::embree:
      return "#9a4fb0";
    case ContenderKind::subdivision:
      break;
  }
  return "#c2185b";
}

PlotSeries line_of(const Measurement& measurement, const Spread& y, const std::string& label) {
  PlotSeries series{.name = measurement.contender.method(), .color = color_of(measurement.contender)};
  series.points.push_back({1, y.median, y.least, y.most, label});
  series.dashed = measurement.contender.is_embree();
  series.level_line = true;
  return series;
}

void write_time_rows(std::ostream& out, const std::vector<Measurement>& measurements) {
  std::vector<Phase> shown;
  for (const Phase phase : phases)
    if (std::any_of(measurements.begin(), measurements.end(), [&](const auto& one) { return one.is_timed(phase); }))
      shown.push_back(phase);
  out << "<table><tr><th>method";
  for (const Phase phase : shown) out << "<th class=n>" << name_of(phase) << " s";
  out << "<th class=n>memory<th class=n>peak</tr>\n";
  for (const Measurement& one : measurements) {
    out << "<tr><td>" << one.contender.name();
    if (!one.is_timed()) {
      out << "<td colspan=" << shown.size() << '>' << (one.estimated ? "not run" : "not timed") << "<td class=n>"
          << (one.estimated ? "about " : "") << megabytes(one.bytes) << "<td></tr>\n";
      continue;
    }
    for (const Phase phase : shown) out << "<td class=n>" << to_text(spread(one.times(phase)));
    out << "<td class=n>" << megabytes(one.bytes) << "<td class=n>" << megabytes(one.peak_bytes) << "</tr>\n";
  }
  out << "</table>\n";
}

void write_error_rows(std::ostream& out, const std::vector<Measurement>& measurements) {
  out << "<table><tr><th>method<th class=n>distance: median<th class=n>99 %<th class=n>max<th class=n>normal rad: "
         "median<th class=n>99 %<th class=n>max<th class=n>lost<th class=n>ghosts<th class=n>farther<th "
         "class=n>nearer<th class=n>outside: lost<th class=n>ghosts</tr>\n";
  const auto cell = [&](const std::string& text) { out << "<td class=n>" << text; };
  for (const Measurement& one : measurements) {
    if (one.estimated) continue;
    out << "<tr><td>" << one.contender.name();
    for (const Quantiles* const of : {&one.errors.distance, &one.errors.normal})
      for (const double value : {of->median, of->p99, of->max}) cell(digits(value, 2));
    cell(std::to_string(one.errors.lost));
    cell(std::to_string(one.errors.ghosts));
    if (one.contender.is_adaptive())
      for (const std::size_t value :
           {one.errors.farther, one.errors.nearer, one.errors.lost_outside, one.errors.ghosts_outside})
        cell(std::to_string(value));
    else
      out << "<td colspan=4>";
    out << "</tr>\n";
  }
  out << "</table>\n";
}

}  // namespace shaolin
