/// The subcommands of `bench` at small sizes.
#include <malloc.h>

#include <iterator>
#include <map>
#include <sstream>

#include "tests/catch.h"
#include "tests/tools/cli_run.h"
#include "tools/bench/paper_figures.h"
#include "tools/cli/json_text.h"

namespace shaolin::test {
namespace {

/// A table's rows by the names of its columns.
struct Table {
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;

  explicit Table(const std::filesystem::path& file) : rows(read_rows(file)) {
    INFO(file);
    REQUIRE(rows.size() > 1);
    header = rows.front();
    rows.erase(rows.begin());
    for (const auto& row : rows) REQUIRE(row.size() == header.size());
  }

  std::string text(std::size_t row, const std::string& column) const {
    const auto at = std::find(header.begin(), header.end(), column);
    INFO(column);
    REQUIRE(at != header.end());
    return rows[row][static_cast<std::size_t>(at - header.begin())];
  }
  double number(std::size_t row, const std::string& column) const { return std::stod(text(row, column)); }
};

/// Of one row, all columns that begin so.
double sum_of(const Table& table, std::size_t row, const std::string& prefix) {
  double sum = 0;
  for (std::size_t i = 0; i < table.header.size(); ++i)
    if (table.header[i].starts_with(prefix)) sum += std::stod(table.rows[row][i]);
  return sum;
}

/// Rows of these rays.
std::vector<std::size_t> rows_of(const Table& errors, const std::string& rays) {
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < errors.rows.size(); ++i)
    if (errors.text(i, "of") == rays) rows.push_back(i);
  return rows;
}

bool is_by_triangles(const std::string& method) { return method == "Uniform" || method == "Embree triangles"; }

/// What must be true of every measurement, by rays that tell distances.
void check_errors(const Table& errors, const std::string& rays = "picture") {
  std::size_t before = 0;
  for (const std::size_t i : rows_of(errors, rays)) {
    CAPTURE(errors.rows[i]);
    const std::string method = errors.text(i, "method");
    CHECK(errors.number(i, "distance_median") <= errors.number(i, "distance_p99"));
    CHECK(errors.number(i, "distance_p99") <= errors.number(i, "distance_max"));
    if (method == "ShaoLin exact")
      for (const char* column : {"distance_max", "normal_max", "lost", "ghosts"}) CHECK(errors.number(i, column) == 0);
    // A3 has no border areas: at outlines where control meshes are coarse it loses more than its tolerance implies.
    if (method == "ShaoLin")
      for (const char* column : {"lost_outside", "ghosts_outside"}) CHECK(errors.number(i, column) == 0);
    // Chords of a smooth surface: the error falls to a quarter with each level.
    if (is_by_triangles(method) && errors.text(i, "parameter") != "1") {
      CHECK(errors.text(before, "method") == method);
      const double factor = errors.number(before, "distance_median") / errors.number(i, "distance_median");
      CHECK(factor > 2.5);
      CHECK(factor < 6);
    }
    before = i;
  }
}

/// What must be true of the times of a picture's rays.
void check_times(const Table& times, std::size_t row, int runs) {
  CHECK(times.number(row, "runs") == runs);
  for (const std::string phase : {"build", "cold", "camera", "shadow"}) {
    CAPTURE(phase);
    CHECK(times.number(row, phase + "_least") > 0);
    CHECK(times.number(row, phase + "_least") <= times.number(row, phase));
    CHECK(times.number(row, phase) <= times.number(row, phase + "_most"));
  }
  CHECK(times.text(row, "tessellation").empty() == (times.text(row, "method") != "Embree triangles"));
  CHECK(times.number(row, "build_least") < times.number(row, "cold_least"));
  CHECK(times.number(row, "bytes") > 0);
  CHECK(times.number(row, "estimated") == 0);
}

}  // namespace

TEST_CASE("bench paper counts every hit once, and its files can be read", "[tools][cli][bench][sweep]") {
  const Folder folder;
  const Outcome outcome = folder.run({"bench", "paper", "--size", "40x40", "--runs", "2", "--level", "3", "--only",
                                      "frogship", "--scenes", data_file("scenes"), "--report", folder / "out/paper"});
  CAPTURE(outcome.text);
  REQUIRE(outcome.status == 0);
  const auto file = [&](const std::string& name) { return folder / ("out/paper/" + name); };
  const Table levels(file("levels.csv")), errors(file("errors.csv")), times(file("times.csv"));
  REQUIRE(levels.rows.size() == 1 + 2 * 7 + 2 * 3);
  REQUIRE(errors.rows.size() == levels.rows.size());
  REQUIRE(times.rows.size() == levels.rows.size());
  double before = 100;
  for (std::size_t i = 0; i < levels.rows.size(); ++i) {
    CAPTURE(levels.rows[i]);
    const double hits = sum_of(levels, i, "primary_") + sum_of(levels, i, "shadow_");
    CHECK(hits == errors.number(i, "hits") - errors.number(i, "lost") + errors.number(i, "ghosts"));
    CHECK(hits > 300);
    if (levels.text(i, "method") == "ShaoLin") {
      CHECK(levels.number(i, "mean_level") <= before);
      before = levels.number(i, "mean_level");
    }
    if (is_by_triangles(levels.text(i, "method")))
      CHECK(levels.number(i, "mean_level") == levels.number(i, "parameter"));
    check_times(times, i, 2);
    for (const std::string phase : {"random", "ambient"}) CHECK(times.text(i, phase).empty());
  }
  check_errors(errors);

  const Table memory(file("memory.csv"));
  CHECK(memory.rows.size() == 2 * (2 + 1));
  for (std::size_t i = 0; i < memory.rows.size(); ++i) CHECK(memory.number(i, "bytes") > 1e5);
  const std::string page = read_file(file("paper.html"));
  for (const char* text : {"Table 1", "4.74", "118007", "1635 MB", "<svg", "frogship-a3.png", "levels.csv"})
    CHECK(page.find(text) != std::string::npos);
  for (const char* picture : {"frogship-picture.png", "frogship-shaolin.png", "frogship-a3.png"})
    CHECK(read_file(file(picture)).starts_with("\x89PNG"));
}

TEST_CASE("bench paper estimates levels that would not fit", "[tools][cli][bench]") {
  const Folder folder;
  REQUIRE(folder
              .run({"bench", "paper", "--size", "24x24", "--runs", "1", "--level", "4", "--memory", "4", "--only",
                    "frogship", "--catmark", "--scenes", data_file("scenes"), "--report", folder / "out"})
              .status == 0);
  const Table times(folder / "out/times.csv"), memory(folder / "out/memory.csv");
  for (std::size_t i = 1; i < times.rows.size(); ++i) {
    if (times.text(i, "method") != "Uniform") continue;
    const bool estimated = times.number(i, "parameter") >= 4;
    CHECK(times.number(i, "estimated") == (estimated ? 1 : 0));
    CHECK(times.text(i, "cold").empty() == estimated);
    if (estimated) CHECK(times.number(i, "bytes") == 4 * times.number(i - 1, "bytes"));
  }
  CHECK(memory.number(3, "level") == 4);
  CHECK(memory.number(3, "estimated") == 1);
}

TEST_CASE("bench pareto measures every phase of several scenes", "[tools][cli][bench][sweep]") {
  const Folder folder;
  const Outcome outcome =
      folder.run({"bench", "pareto", data_file("torus.obj"), data_file("loop_torus.obj"), "--size", "32x32", "--runs",
                  "2", "--level", "4", "--exact-hits", "20", "--report", folder / "out"});
  CAPTURE(outcome.text);
  REQUIRE(outcome.status == 0);
  CHECK(outcome.text.find("Embree's subdivision is left out: Embree subdivides by Catmull-Clark alone") !=
        std::string::npos);
  const Table errors(folder / "out/errors.csv"), times(folder / "out/times.csv"), exact(folder / "out/exact.csv");
  const std::size_t without_subdivision = 1 + 2 * 9 + 2 * 4;
  REQUIRE(times.rows.size() == 2 * without_subdivision + 4);
  REQUIRE(errors.rows.size() == 3 * times.rows.size());
  check_errors(errors, "picture");
  check_errors(errors, "random");
  for (const std::size_t i : rows_of(errors, "ambient")) {
    CHECK(errors.number(i, "rays") > 150);
    CHECK(errors.number(i, "lost") <= errors.number(i, "hits"));
    CHECK(errors.text(i, "distance_max").empty());
    if (errors.text(i, "method") == "ShaoLin exact") CHECK(errors.number(i, "lost") + errors.number(i, "ghosts") == 0);
  }
  double most_peak = 0;
  for (std::size_t i = 0; i < times.rows.size(); ++i) {
    CAPTURE(times.rows[i]);
    check_times(times, i, 2);
    for (const std::string phase : {"random", "ambient"}) CHECK(times.number(i, phase) > 0);
    most_peak = std::max(most_peak, times.number(i, "peak_bytes"));
  }
  CHECK(most_peak > 0);  // a run may find all the room that it needs where others were

  // Both are 3 across.
  REQUIRE(exact.rows.size() == 2);
  for (std::size_t i = 0; i < 2; ++i) {
    CHECK(exact.number(i, "hits") == 20);
    for (const char* column : {"position_max", "across_max", "along_max"}) {
      CHECK(exact.number(i, column) > 0);
      CHECK(exact.number(i, column) < 1e-14);
    }
  }

  const std::string page = read_file(folder / "out/pareto.html");
  for (const char* text : {"99th percentile", "<h2>torus", "<h2>loop_torus", "memory against", "Embree subdivision",
                           "Random rays", "Rays of ambient occlusion", "<td>loop_torus<td>Embree triangles, level 3"})
    CHECK(page.find(text) != std::string::npos);
  CHECK(page.find("nan") == std::string::npos);
  const Json json = read_json(folder / "out/pareto.json");
  REQUIRE(json.at("scenes").size() == 2);
  std::size_t row = 0;
  for (const Json& scene : json.at("scenes")) {
    CHECK(scene.contains("embree_subdivision_left_out") == (scene.at("scene") == "loop_torus"));
    CHECK(scene.at("rays").at("primary") == 1024);
    CHECK(scene.at("rays").at("random") == 1024);
    for (const Json& one : scene.at("measurements")) {
      CHECK(one.at("method") == times.text(row, "method"));
      CHECK(one.at("seconds").at("cold").at("median") == times.number(row, "cold"));
      std::size_t error_row = 3 * row;
      for (const char* rays : {"picture", "random", "ambient"}) {
        const Json& figures = one.at("errors").at(rays);
        CHECK(errors.text(error_row, "of") == rays);
        for (const char* count : {"rays", "hits", "lost", "ghosts"})
          CHECK(figures.at(count) == errors.number(error_row, count));
        if (rays != std::string("ambient"))
          for (const char* quantile : {"median", "p99", "max"}) {
            CHECK(figures.at("distance").at(quantile) == errors.number(error_row, std::string("distance_") + quantile));
            CHECK(figures.at("normal").at(quantile) == errors.number(error_row, std::string("normal_") + quantile));
          }
        ++error_row;
      }
      CHECK(one.at("seconds").contains("tessellation") == (one.at("method") == "Embree triangles"));
      for (const auto& [phase, seconds] : one.at("seconds").items()) CHECK(seconds.at("runs").size() == 2);
      ++row;
    }
    // What the exact method takes over Embree: of two runs the median is the mean.
    const Json& exact_seconds = scene.at("measurements").at(0).at("seconds");
    const bool is_loop = scene.at("scene") == "loop_torus";
    CHECK(scene.at("exact_over_peers").size() == (is_loop ? 4 : 8));
    for (const Json& ratios : scene.at("exact_over_peers")) {
      const Json& all = scene.at("measurements");
      const auto peer = std::find_if(all.begin(), all.end(), [&](const Json& one) {
        return one.at("method") == ratios.at("method") && one.value("level", 0) == ratios.at("level");
      });
      REQUIRE(peer != all.end());
      for (const char* phase : {"cold", "camera", "random", "shadow", "ambient"}) {
        double sum = 0;
        for (const std::size_t run : {0, 1})
          sum += exact_seconds.at(phase).at("runs").at(run).get<double>() /
                 peer->at("seconds").at(phase).at("runs").at(run).get<double>();
        CHECK(ratios.at(phase).at("median").get<double>() == Approx(sum / 2));
      }
      CHECK(ratios.contains("cold given triangles") == (ratios.at("method") == "Embree triangles"));
      CHECK(ratios.at("memory").get<double>() ==
            Approx(all.at(0).at("bytes").get<double>() / peer->at("bytes").get<double>()));
    }
    // The terminal ends with the bars, of which level 5 was not run.
    const std::string scheme = is_loop ? "Embree triangles" : "Embree subdivision";
    CHECK(outcome.text.find(scheme + ", level 3 ", outcome.text.find("\n| scene")) != std::string::npos);
    CHECK(outcome.text.find(scheme + ", level 4 ", outcome.text.find("\n| scene")) == std::string::npos);
  }
  CHECK(row == times.rows.size());
}

TEST_CASE("bench pareto measures the methods that it is asked for, and the exact one", "[tools][cli][bench]") {
  const Folder folder;
  const auto methods_of = [&](const std::vector<std::string>& options) {
    std::vector<std::string> words{
        "bench",   "pareto", data_file("torus.obj"), "--size", "16x16",    "--runs",      "1",
        "--level", "1",      "--exact-hits",         "0",      "--report", folder / "out"};
    words.insert(words.begin() + 2, options.begin(), options.end());
    const Outcome outcome = folder.run(words);
    CAPTURE(outcome.text);
    REQUIRE(outcome.status == 0);
    const Table times(folder / "out/times.csv");
    std::set<std::string> methods;
    for (std::size_t i = 0; i < times.rows.size(); ++i) methods.insert(times.text(i, "method"));
    return methods;
  };
  CHECK(methods_of({"--methods", "triangles"}) == std::set<std::string>{"ShaoLin exact", "Embree triangles"});
  CHECK(methods_of({"--methods", "subdivision,uniform", "--methods", "exact"}) ==
        std::set<std::string>{"ShaoLin exact", "Embree subdivision", "Uniform"});
  CHECK(methods_of({"--methods", "chord,a3"}) == std::set<std::string>{"ShaoLin exact", "ShaoLin", "A3"});
}

TEST_CASE("bench scaling tells what each size costs", "[tools][cli][bench]") {
  const Folder folder;
  const Outcome outcome = folder.run({"bench", "scaling", "--faces", "200", "2000", "--instanced", "8000", "--size",
                                      "32x32", "--runs", "2", "--report", folder / "out"});
  CAPTURE(outcome.text);
  REQUIRE(outcome.status == 0);
  const Table table(folder / "out/scaling.csv");
  REQUIRE(table.rows.size() == 3);
  for (std::size_t i = 0; i < 3; ++i) {
    CAPTURE(table.rows[i]);
    const bool one_mesh = i < 2;
    CHECK(table.text(i, "scene") == (one_mesh ? "one mesh" : "instances"));
    CHECK((table.text(i, "read").empty() || table.number(i, "read") > 0));
    CHECK(table.text(i, "read").empty() != one_mesh);
    for (const char* column : {"build", "cold_1", "cold_2", "warm_1", "warm_2", "bytes_refined"})
      CHECK(table.number(i, column) > 0);
    // The allocator of sanitizers does not tell; then neither does the bench.
    CHECK((table.number(i, "bytes") > 0) == (mallinfo2().uordblks > 0));
    CHECK(table.number(i, "rays") == 32 * 32);
    CHECK(table.number(i, "hits") > 100);
    CHECK(table.number(i, "hits") < 32 * 32);
    CHECK(table.number(i, "faces_touched") > 50);
    // 400 bytes a face are generous: a regression of what a face costs that no ray meets.
    if (one_mesh) CHECK(table.number(i, "bytes") < 400 * table.number(i, "faces") + 100000);
  }
  CHECK(table.number(0, "faces") == Approx(200).epsilon(0.1));
  CHECK(table.number(1, "faces") == Approx(2000).epsilon(0.1));
  CHECK(table.number(2, "instances") == 1);
  CHECK(read_file(folder / "out/scaling.html").find("<svg") != std::string::npos);
  CHECK_FALSE(std::filesystem::exists(folder / "out/torus-200.obj"));
}

TEST_CASE("bench lost counts its rays, and fails if it lists any", "[tools][cli][bench][sweep]") {
  const Folder folder;
  for (const std::vector<std::string>& more : std::vector<std::vector<std::string>>{{}, {"--a3", "--threads", "1"}}) {
    std::vector<std::string> words{
        "bench", "lost", data_file("torus.obj"), data_file("scenes/mirrors.json"), "--rays", "2000", "--seed", "7"};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome outcome = folder.run(words);
    CAPTURE(outcome.text);
    const auto lines = split(outcome.text, '\n');
    const bool listed = outcome.text.find("outside: ") != std::string::npos;
    CHECK(outcome.status == (listed ? 1 : 0));
    CHECK(lines[lines.size() - 2] == (listed ? "FAIL" : "PASS"));
    std::istringstream row(lines[1]);
    std::string model;
    double epsilon = 0, rays = 0, hits = 0, lost = 0, ghosts = 0, farther = 0, nearer = 0, lost_out = 0, ghosts_out = 0;
    row >> model >> epsilon >> rays >> hits >> lost >> ghosts >> farther >> nearer >> lost_out >> ghosts_out;
    CHECK(model == "torus");
    CHECK(rays == 2200);
    CHECK(hits > 1000);
    CHECK(lost_out <= lost + farther);
    CHECK(ghosts_out <= ghosts + nearer);
    CHECK(lost_out + ghosts_out <= rays / 100);
  }
}

TEST_CASE("bench closest holds closest points against brute force and triangles", "[tools][cli][bench]") {
  const Folder folder;
  const Outcome outcome = folder.run({"bench", "closest", data_file("rook.obj"), data_file("loop_torus.obj"),
                                      "--checked", "40", "--queries", "100", "--runs", "1", "--error", "1e-3"});
  CAPTURE(outcome.text);
  CHECK(outcome.status == 0);
  const auto lines = split(outcome.text, '\n');
  REQUIRE(lines.size() >= 3);
  for (const std::size_t i : {1, 2}) {
    std::istringstream row(lines[i]);
    std::string model;
    double checked = 0, wrong = 0, worst = 0, level = 0, triangles = 0, error = 0, ours = 0, theirs = 0;
    row >> model >> checked >> wrong >> worst >> level >> triangles >> error >> ours >> theirs;
    CHECK(model == (i == 1 ? "rook" : "loop_torus"));
    CHECK(checked == 40);
    CHECK(wrong == 0);
    CHECK(worst < 1e-12);
    // Triangles are off, and not by more than was asked: level 0 would be, by far.
    CHECK(level >= 1);
    CHECK(triangles > 500);
    CHECK((error > 1e-7 && error <= 1e-3));
    CHECK((ours > 0 && theirs > 0));
  }
}

TEST_CASE("bench moved: the exact method stays exact, single precision does not", "[tools][cli][bench]") {
  const Folder folder;
  const Outcome outcome = folder.run({"bench", "moved", data_file("torus.obj"), "--shifts", "0,1e6", "--scales", "1e-6",
                                      "--rays", "500", "--exact-hits", "5", "--level", "3"});
  CAPTURE(outcome.text);
  CHECK(outcome.status == 0);
  const auto lines = split(outcome.text, '\n');
  std::map<std::string, double> median;  // by move and method
  int rows = 0;
  for (const std::string& line : lines) {
    if (!line.starts_with("torus ")) continue;
    ++rows;
    const auto words = [&] {
      std::istringstream in(line);
      return std::vector<std::string>(std::istream_iterator<std::string>(in), {});
    }();
    const std::string method = words[3] + words[4];
    median[words[2] + " " + method] = std::stod(words[words.size() - 3]);
    const double hits = std::stod(words[words.size() - 6]);
    CHECK((method == "Embreetriangles," || method == "Embreesubdivision," || hits > 300));
  }
  CHECK(rows == 3 * 4);
  CHECK(median.at("0 ShaoLinexact") < 1e-15);
  CHECK(median.at("1e-06 ShaoLinexact") < 1e-15);
  CHECK(median.at("1e+06 ShaoLinexact") < 1e-9);
  // At level 3 triangles are off by some 1e-3; a float has no digits left for the model at 1e6 diagonals.
  CHECK((median.at("0 CGAL,level") > 1e-6 && median.at("0 CGAL,level") < 1e-2));
  CHECK(median.at("1e+06 CGAL,level") < 1e-2);
  CHECK((median.at("1e+06 Embreesubdivision,") > 1e-2 || median.at("1e+06 Embreesubdivision,") == 0));
}

TEST_CASE("bench says what is wrong with its options", "[tools][cli][bench]") {
  const Folder folder;
  const std::string file = folder.write("file", ""), report = folder / "out", torus = data_file("torus.obj");
  const std::string scenes = data_file("scenes");
  for (const std::vector<std::string>& usage : std::vector<std::vector<std::string>>{
           {"bench"},
           {"bench", "paper"},
           {"bench", "paper", "--report", report, "--only", "dragon"},
           {"bench", "paper", "--report", report, "--size", "0x8"},
           {"bench", "paper", "--report", report, "--runs", "0"},
           {"bench", "paper", "--report", report, "--level", "11"},
           {"bench", "pareto", "--report", report},
           {"bench", "pareto", torus},
           {"bench", "pareto", torus, "--report", report, "--scheme", "doo-sabin"},
           {"bench", "pareto", torus, "--report", report, "--methods", "embree"},
           {"bench", "pareto", torus, "--report", report, "--methods", "exact,dragon"},
           {"bench", "pareto", torus, "--report", report, "--methods"},
           {"bench", "pareto", torus, "--report", report, "--unit", "0"},
           {"bench", "pareto", torus, "--report", report, "--unit", "nan"},
           {"bench", "scaling"},
           {"bench", "scaling", "--report", report, "--faces", "8"},
           {"bench", "scaling", "--report", report, "--runs", "0"},
           {"bench", "lost"},
           {"bench", "lost", torus, "--rays", "0"},
           {"bench", "lost", torus, "--epsilon", "-1"},
           {"bench", "closest"},
           {"bench", "closest", torus, "--error", "0"},
           {"bench", "closest", torus, "--runs", "0"},
           {"bench", "moved"},
           {"bench", "moved", torus, "--shifts", "-1"},
           {"bench", "moved", torus, "--scales", "0"},
       }) {
    CAPTURE(usage);
    CHECK(folder.run(usage).status == 2);
  }
  for (const std::vector<std::string>& bad : std::vector<std::vector<std::string>>{
           {"bench", "paper", "--report", report, "--scenes", folder / "nowhere"},
           {"bench", "paper", "--report", file, "--scenes", scenes},
           {"bench", "pareto", folder / "nothing.obj", "--report", report},
           {"bench", "pareto", file, "--report", report},
           {"bench", "pareto", torus, folder / "nothing.obj", "--report", report},
           {"bench", "scaling", "--report", file},
           {"bench", "lost", folder / "nothing.obj"},
           {"bench", "closest", folder / "nothing.obj"},
           {"bench", "closest", data_file("scenes/mirrors.json")},
           {"bench", "moved", folder / "nothing.obj"},
           {"bench", "moved", data_file("scenes/mirrors.json")},
       }) {
    CAPTURE(bad);
    const Outcome outcome = folder.run(bad);
    CHECK(outcome.status == 3);
    CHECK(outcome.text.find("shaolin: error: ") != std::string::npos);
  }
}

}  // namespace shaolin::test
