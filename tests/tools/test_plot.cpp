/// Plots and tables of the bench's pages.
#include <sstream>

#include "tests/catch.h"
#include "tools/bench/plot.h"
#include "tools/bench/plot_labels.h"
#include "tools/bench/text_table.h"

namespace shaolin::test {

TEST_CASE("A plot holds what is positive, and a legend", "[tools][bench]") {
  Plot plot{.x_label = "x < y", .y_label = "time"};
  plot.series.push_back({.name = "a", .color = "#111", .points = {{1, 2, 1, 3, "p"}, {0, 1}, {10, 20}}});
  plot.series.push_back({.name = "b", .color = "#222", .points = {{1, 5, 0, 0, "line"}}, .level_line = true});
  std::ostringstream out;
  write_svg(out, plot);
  const std::string svg = out.str();
  const auto count = [&](const std::string& what) {
    std::size_t found = 0;
    for (std::size_t at = svg.find(what); at != std::string::npos; at = svg.find(what, at + 1)) ++found;
    return found;
  };
  CHECK(count("<circle") == 2);
  CHECK(count(">line<") == 1);
  CHECK(count("x &lt; y") == 1);
  CHECK(count("nan") + count("inf") == 0);
}

TEST_CASE("Labels of points cover neither each other nor marks", "[tools][bench]") {
  PointLabels labels;
  labels.add_mark(100, 100);
  std::vector<LabelPlace> places;
  while (const auto place = labels.place(100, 100, 2)) places.push_back(*place);
  REQUIRE(places.size() >= 4);  // then there is no room
  CHECK(places.size() <= 8);
  CHECK(places.front().x > 100);
  CHECK(places.front().y < 100);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const LabelPlace& one = places[i];  // 12 wide, 7.5 high
    CHECK((one.x >= 103.2 || one.x + 12 <= 96.8 || one.y <= 96.8 || one.y - 7.5 >= 103.2));
    for (std::size_t j = 0; j < i; ++j)
      CHECK((std::abs(one.x - places[j].x) >= 12 || std::abs(one.y - places[j].y) >= 7.5));
  }
  CHECK(labels.place(200, 100, 2));
}

TEST_CASE("Lines' labels move apart by as little as they can", "[tools][bench]") {
  CHECK(moved_apart({}, 12).empty());
  CHECK(moved_apart({10, 30, 50}, 12) == std::vector<double>{10, 30, 50});
  CHECK(moved_apart({20, 20}, 12) == std::vector<double>{14, 26});
  CHECK(moved_apart({0, 100, 102, 104, 200}, 12) == std::vector<double>{0, 90, 102, 114, 200});
}

TEST_CASE("A table as Markdown and as HTML", "[tools][bench]") {
  const TextTable table{.header = {"scene", "a < b"}, .rows = {{"torus", "1.25"}, {"x", ""}}};
  std::ostringstream markdown, html;
  write_markdown(markdown, table);
  CHECK(markdown.str() ==
        "| scene | a < b |\n"
        "|:------|------:|\n"
        "| torus | 1.25  |\n"
        "| x     |       |\n");
  write_html(html, table);
  CHECK(html.str() ==
        "<table><tr><th>scene<th class=n>a &lt; b</tr>\n"
        "<tr><td>torus<td class=n>1.25</tr>\n"
        "<tr><td>x<td class=n></tr>\n"
        "</table>\n");
}

}  // namespace shaolin::test
