#include <algorithm>
#include <array>
#include <cmath>

#include "tools/bench/page_parts.h"
#include "tools/bench/paper.h"
#include "tools/cli/html.h"

namespace shaolin {
namespace {

/// "0-1", 2, ..., 7 of the paper's tables, and what is deeper.
std::array<std::uint64_t, 8> as_in_tables(const LevelCounts& counts) {
  std::array<std::uint64_t, 8> columns{};
  for (std::size_t level = 0; level < LevelCounts::levels; ++level)
    columns[level < 2 ? 0 : std::min<std::size_t>(level - 1, 7)] += counts.hits[level];
  return columns;
}

void write_level_rows(std::ostream& out, const PaperResult& result) {
  out << "<table><tr><th>&epsilon;<th><th class=n>mean level<th class=n>0&ndash;1";
  for (int level = 2; level <= 7; ++level) out << "<th class=n>" << level;
  out << "<th class=n>8 and deeper<th class=n>in all</tr>\n";
  for (const PaperLevels& row : result.scene->levels) {
    for (const ContenderKind kind : {ContenderKind::chord, ContenderKind::a3}) {
      const Measurement* const ours = result.find(kind, row.epsilon);
      if (ours == nullptr) continue;
      out << "<tr><td>" << row.epsilon << "<td>" << ours->contender.method() << "<td class=n>"
          << digits(ours->levels().mean());
      for (const std::uint64_t hits : as_in_tables(ours->levels())) out << "<td class=n>" << hits;
      out << "<td class=n>" << ours->levels().total() << "</tr>\n";
    }
    int total = 0;
    out << "<tr><td class=paper><td class=paper>paper<td class='n paper'>" << row.mean;
    for (const int hits : row.hits) {
      out << "<td class='n paper'>" << hits;
      total += hits;
    }
    out << "<td class='n paper'><td class='n paper'>" << total << "</tr>\n";
  }
  out << "</table>\n";
}

/// Our and the paper's mean levels by epsilon.
struct Means {
  std::vector<double> epsilon, ours, paper;

  explicit Means(const PaperResult& result) {
    for (const PaperLevels& row : result.scene->levels)
      if (const Measurement* const one = result.find(ContenderKind::chord, row.epsilon)) {
        epsilon.push_back(row.epsilon);
        ours.push_back(one->levels().mean());
        paper.push_back(row.mean);
      }
  }
  bool falls() const { return std::is_sorted(ours.rbegin(), ours.rend()) && ours.front() > ours.back(); }
  /// The share of the whole fall that has come by the row.
  static double share(const std::vector<double>& means, std::size_t row) {
    const double fall = means.front() - means.back();
    return fall != 0 ? (means.front() - means[row]) / fall : 0;
  }
};

void write_level_words(std::ostream& out, const PaperResult& result) {
  const Means means(result);
  std::size_t worst = 0;
  for (std::size_t i = 0; i < means.ours.size(); ++i)
    if (std::abs(means.ours[i] - means.paper[i]) > std::abs(means.ours[worst] - means.paper[worst])) worst = i;
  out << "<p>Where it agrees: "
      << (means.falls() ? "the mean level falls with every step of &epsilon;, here from "
                        : "it should fall with &epsilon;; here it does not at every step, from ")
      << digits(means.ours.front()) << " to " << digits(means.ours.back()) << ", in the paper from "
      << means.paper.front() << " to " << means.paper.back() << ". By &epsilon; = " << means.epsilon[2] << ", "
      << digits(100 * Means::share(means.ours, 2), 2) << " % of the fall have come, in the paper "
      << digits(100 * Means::share(means.paper, 2), 2)
      << " %. Where it does not: the means are furthest apart at &epsilon; = " << means.epsilon[worst] << ", by "
      << digits(means.ours[worst] - means.paper[worst], 2)
      << " levels. Why: the models have the paper's numbers of faces, not its shapes and cameras, so the sizes of "
         "faces on "
         "the screen, which bound levels from both sides, differ, and so do the numbers of rays that hit. The paper's "
         "&epsilon; is a length without a unit; here 1 stands for "
      << result.scene->unit
      << " of the scene's, chosen so that the fall has the same size. That the fall is as large is thus no "
      << "finding, where it happens is. What mirrors reflect is not counted here; whether the paper did is not "
         "said.</p>\n";
}

Spread cold_time(const Measurement& one) { return spread(one.times(Phase::cold)); }

void write_time_plot(std::ostream& out, const PaperResult& result) {
  Plot plot{.x_label = "epsilon, in units of the scene", .y_label = "time, s"};
  for (const PaperLevels& row : result.scene->levels) plot.x_ticks.push_back(row.epsilon);
  for (const ContenderKind kind : {ContenderKind::chord, ContenderKind::a3})
    plot.series.push_back(series_of(
        result.measurements, kind, [](const auto& m) { return m.contender.epsilon; }, cold_time));
  for (const Measurement& one : result.measurements) {
    if (!one.is_timed() || one.contender.is_adaptive()) continue;
    const bool is_exact = one.contender.kind == ContenderKind::exact;
    plot.series.push_back(
        line_of(one, cold_time(one), is_exact ? "exact" : "level " + std::to_string(one.contender.level)));
  }
  out << "<figure>";
  write_svg(out, plot);
  out << "<figcaption>" << html_escaped(result.scene->title)
      << ": time over &epsilon;; median, bars from least to most</figcaption></figure>\n";
}

/// "1.2 to 1.5": the medians of a / b over all epsilons.
Spread factors(const PaperResult& result, ContenderKind a, ContenderKind b) {
  std::vector<double> all;
  for (const PaperLevels& row : result.scene->levels) {
    const Measurement *const first = result.find(a, row.epsilon), *const second = result.find(b, row.epsilon);
    if (first != nullptr && second != nullptr && first->is_timed() && second->is_timed())
      all.push_back(ratio(*first, *second).median);
  }
  return spread(all);
}

void write_time_words(std::ostream& out, const PaperResult& result) {
  const Spread factor = factors(result, ContenderKind::a3, ContenderKind::chord);
  out << "<p>A3 takes " << to_text(factor) << " times as long as ShaoLin (median over &epsilon; of the runs' median "
      << "ratios; least to most). The paper draws A3 noticeably slower in all three scenes: "
      << (factor.least > 1.05   ? "so it is here, at every &epsilon;."
          : factor.median > 1.0 ? "here it is slower by the median only."
                                : "here it is not.");
  const Measurement* const ours = result.find(ContenderKind::chord, paper_epsilon);
  if (ours != nullptr && ours->is_timed()) {
    const int like = static_cast<int>(std::lround(ours->levels().mean()));
    const Measurement* const uniform = result.find(ContenderKind::uniform, like);
    const Measurement* const embree = result.find(ContenderKind::triangles, like);
    out << " Against triangles of the level that is nearest to the mean at &epsilon; = " << paper_epsilon << ", "
        << like << ", ShaoLin takes ";
    if (uniform != nullptr && uniform->is_timed())
      out << digits(ratio(*ours, *uniform).median) << " times Uniform's time";
    if (embree != nullptr && embree->is_timed())
      out << " and " << digits(ratio(*ours, *embree).median) << " times that of the same triangles under Embree";
    out << ". The paper found them alike in the simple scene and ShaoLin ahead in the others.";
  }
  out << " Why it may differ: memory of 2003 held no level beyond those of Table 4, and the triangles' time was that "
         "of "
         "making them; today making and traversing triangles in a hierarchy is cheap as long as they fit, and "
         "instances "
         "share them here. Times are of rays alone, on one thread, cold: from meshes in memory to the last answer; the "
         "paper's are of whole pictures on a Pentium 4, so that only ratios compare.</p>\n";
}

/// Of Table 4: uniform levels 3 to 7.
constexpr std::size_t memory_levels = 5;

void write_memory_row(std::ostream& out, const std::string& name, const MemoryFigures& figures) {
  out << "<tr><td>" << name << "<td class=n>" << megabytes(figures.shaolin) << "<td class=n>" << megabytes(figures.a3);
  for (std::size_t i = 0; i < memory_levels; ++i) {
    out << "<td class=n>";
    if (i < figures.uniform.size())
      out << (figures.uniform[i].estimated ? "about " : "") << megabytes(figures.uniform[i].bytes);
  }
  out << "</tr>\n";
}

void write_paper_memory_row(std::ostream& out, const PaperScene& scene) {
  out << "<tr><td class=paper>" << html_escaped(scene.title) << ", paper<td class='n paper'>" << scene.shaolin_mb
      << " MB<td class='n paper'>the same";
  for (const auto& printed : scene.uniform_mb)
    out << "<td class='n paper'>" << (printed ? std::to_string(*printed) + " MB" : "&ndash;");
  out << "</tr>\n";
}

/// "below level 5": the first uniform level that takes more.
std::string place_among_levels(const MemoryFigures& figures) {
  std::size_t level = 0;
  while (level < figures.uniform.size() && figures.uniform[level].bytes <= figures.shaolin) ++level;
  return level < figures.uniform.size() ? "below level " + std::to_string(level + 3) : "above all levels measured";
}

void write_memory(std::ostream& out, const std::vector<PaperResult>& results) {
  out << "<h2>Table 4: memory</h2>\n<table><tr><th><th class=n>ShaoLin<th class=n>A3";
  for (std::size_t i = 0; i < memory_levels; ++i) out << "<th class=n>uniform, level " << i + 3;
  out << "</tr>\n";
  std::string places;
  for (const PaperResult& result : results) {
    const std::string title = html_escaped(result.scene->title);
    write_memory_row(out, title + ", a mesh for each instance", result.alone);
    write_memory_row(out, title + ", instances share", result.shared);
    write_paper_memory_row(out, *result.scene);
    places += (places.empty() ? "" : "; ") + title + ": " + place_among_levels(result.alone) +
              " with a mesh for each instance, " + place_among_levels(result.shared) + " where instances share";
  }
  out << "</table>\n<p>ShaoLin and A3 at &epsilon; = " << paper_epsilon
      << ". Bytes held by patches, or by triangles and their hierarchy, after all rays of a picture. 'About': not run, "
         "four times the level before. ShaoLin's memory lies among the uniform levels: "
      << places
      << ". Where it agrees: memory of uniform triangles grows fourfold by level and with all faces, ShaoLin's with "
         "what "
         "rays come near. Where it does not: the paper's machine had no room for most of what stands under 'a mesh for "
         "each instance' here, and its program kept other things for a face than ours does, so that the order of the "
         "columns compares, and bytes do not.</p>\n";
}

void write_maps(std::ostream& out, const PaperResult& result) {
  const PaperScene& scene = *result.scene;
  for (const auto& [what, caption] :
       {std::pair("picture", "ShaoLin"), std::pair("shaolin", "ShaoLin's levels"), std::pair("a3", "A3's levels")})
    out << "<figure><img width=340 src='" << picture_name(scene, what) << "' alt='" << caption << "'><figcaption>"
        << caption << "</figcaption></figure>\n";
  const MapLikeness& maps = result.maps;
  const double both = std::max(1.0, static_cast<double>(maps.both));
  out << "<p>&epsilon; = " << paper_epsilon << ". Of the " << maps.both << " pixels that both methods hit, "
      << digits(100 * static_cast<double>(maps.equal) / both) << " % have the same level and "
      << digits(100 * static_cast<double>(maps.within_one) / both)
      << " % levels that differ by one at most; ShaoLin's level is deeper by " << digits(maps.mean_difference, 2)
      << " on average. " << maps.one_only << " pixels are hit by one of them only.</p>\n";
}

void write_scene(std::ostream& out, const PaperResult& result, int table) {
  out << "<h2>" << html_escaped(result.scene->title) << "</h2>\n<p>" << result.scene->faces << " control faces, "
      << result.primary << " primary and " << result.shadow << " shadow rays; minSize 2, maxSize "
      << result.scene->max_size << " pixels; an &epsilon; of 1 is " << result.scene->unit
      << " of the scene's units, whose diagonal is " << digits(result.diagonal) << ".</p>\n<h3>Table " << table
      << ": ray intersections per level</h3>\n";
  write_level_rows(out, result);
  write_level_words(out, result);
  out << "<h3>Figure 15: time</h3>\n";
  write_time_plot(out, result);
  write_time_words(out, result);
  out << "<h3>Figure 14: level maps</h3>\n";
  write_maps(out, result);
  out << "<h3>Times and memory</h3>\n";
  write_time_rows(out, result.measurements);
  out << "<p>" << time_rows_note << "</p>\n<h3>Errors</h3>\n";
  write_error_rows(out, result.measurements);
  out << "<p>" << error_rows_note << "</p>\n";
  for (const Measurement& one : result.measurements)
    if (!one.fault.empty())
      out << "<p class=FAIL>" << one.contender.name() << " was not timed: " << html_escaped(one.fault) << ".</p>\n";
}

}  // namespace

void write_paper_page(std::ostream& out, const std::vector<PaperResult>& results, const PaperOptions& options) {
  out << html_head("shaolin bench paper", "Adaptive Ray Tracing of Subdivision Surfaces, measured anew")
      << "<p>Tables 1 to 4 and Figures 14 and 15 of M&uuml;ller, Techmann and Fellner "
         "(Eurographics 2003), with "
      << (options.quads ? "the Catmull-Clark versions of " : "") << "scenes modelled anew; " << options.size.width
      << "x" << options.size.height << " pixels, " << options.measure.runs
      << " runs of each time, all methods in turns. The paper's numbers are grey. Every method traces the same rays. "
         "CSV "
         "files beside this page: <a href=levels.csv>levels</a>, <a href=times.csv>times</a>, <a "
         "href=errors.csv>errors</a>, <a href=memory.csv>memory</a>.</p>\n";
  for (const PaperResult& result : results)
    write_scene(out, result, 1 + static_cast<int>(result.scene - paper_scenes().data()));
  if (!results.empty()) write_memory(out, results);
  out << "</html>\n";
}

}  // namespace shaolin
