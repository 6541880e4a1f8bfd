#include "tools/bench/page_parts.h"

#include <algorithm>
#include <cstdio>

#include "tools/bench/text_table.h"

namespace shaolin {

const char* const time_rows_note =
    "Tessellation: what this library takes to make the triangles that Embree is given. Build: from meshes, or these "
    "triangles, in memory to a scene. Cold: both and the first image, its primary and shadow rays. Then what is there "
    "already is asked: camera and shadow rays are the image's; random rays are incoherent; ambient rays are short, as "
    "of "
    "ambient occlusion. Medians, least to most. Memory: bytes held by patches, or by triangles and their hierarchy, "
    "after "
    "all rays; peak: by how much resident memory rose at most, other things and what is freed again included.";

const char* const error_rows_note =
    "Errors are held against the exact method, over all rays that both hit: the distance along the ray between the "
    "hits, "
    "in the scene's unit of length, and the angle between the normals. Lost: only the exact method hits; ghosts: only "
    "the "
    "other does. Farther and nearer: both hit, further apart than the band is wide. Outside: those of them that no "
    "exact "
    "ray explains that runs beside this one, within the band's width of 2 max(epsilon, min size &times; pixel at the "
    "hit). For triangles no band is known.";

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
    case ContenderKind::triangles:
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
    for (const Phase phase : shown)
      out << "<td class=n>" << (one.is_timed(phase) ? to_text(spread(one.times(phase))) : "");
    out << "<td class=n>" << megabytes(one.bytes) << "<td class=n>" << megabytes(one.peak_bytes) << "</tr>\n";
  }
  out << "</table>\n";
}

void write_error_rows(std::ostream& out, const std::vector<Measurement>& measurements,
                      ErrorFigures Measurement::*rays) {
  TextTable table{.header = {"method", "distance: median", "99 %", "max", "normal rad: median", "99 %", "max", "lost",
                             "ghosts", "farther", "nearer", "outside: lost", "ghosts"}};
  for (const Measurement& one : measurements) {
    if (one.estimated) continue;
    const ErrorFigures& errors = one.*rays;
    std::vector<std::string> row{one.contender.name()};
    for (const Quantiles* const of : {&errors.distance, &errors.normal})
      for (const double value : {of->median, of->p99, of->max}) row.push_back(digits(value, 2));
    for (const std::size_t value : {errors.lost, errors.ghosts}) row.push_back(std::to_string(value));
    for (const std::size_t value : {errors.farther, errors.nearer, errors.lost_outside, errors.ghosts_outside})
      row.push_back(one.contender.is_adaptive() ? std::to_string(value) : "");
    table.rows.push_back(row);
  }
  write_html(out, table);
}

void write_hit_rows(std::ostream& out, const std::vector<Measurement>& measurements) {
  TextTable table{.header = {"method", "hits", "lost", "ghosts"}};
  for (const Measurement& one : measurements) {
    if (one.estimated) continue;
    const HitFigures& hits = one.ambient_errors;
    table.rows.push_back({one.contender.name(), std::to_string(hits.own_hits()), std::to_string(hits.lost),
                          std::to_string(hits.ghosts)});
  }
  write_html(out, table);
}

}  // namespace shaolin
