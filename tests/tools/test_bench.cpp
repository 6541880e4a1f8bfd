/// `bench`: what it measures by, and its three subcommands at small sizes.
#include <cmath>
#include <numbers>
#include <sstream>

#include "tests/catch.h"
#include "tests/meshes.h"
#include "tests/tools/cli_run.h"
#include "tools/bench/error_figures.h"
#include "tools/bench/measure.h"
#include "tools/bench/paper_figures.h"
#include "tools/bench/peak_memory.h"
#include "tools/bench/plot.h"
#include "tools/bench/silhouette_band.h"
#include "tools/cli/csv.h"
#include "tools/cli/json_text.h"
#include "tools/validate/quad_oracle.h"

namespace shaolin::test {
namespace {

/// The square [-1, 1] x [-1, 1] in the plane z = 0, seen from above.
Scene plate() {
  ControlMesh mesh = mesh_of({{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, {{0, 1, 2, 3}});
  return Scene(std::move(mesh), "bilinear");
}

Ray down(double x, double y) {
  Ray ray;
  ray.origin = {x, y, 5};
  ray.direction = {0, 0, -2};
  return ray;
}

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

/// What must be true of every measurement.
void check_errors(const Table& errors) {
  for (std::size_t i = 0; i < errors.rows.size(); ++i) {
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
    if (method.starts_with("Uniform") && errors.text(i, "parameter") != "1") {
      CHECK(errors.text(i - 1, "method") == method);
      const double factor = errors.number(i - 1, "distance_median") / errors.number(i, "distance_median");
      CHECK(factor > 2.5);
      CHECK(factor < 6);
    }
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
  CHECK(times.number(row, "build_least") < times.number(row, "cold_least"));
  CHECK(times.number(row, "bytes") > 0);
  CHECK(times.number(row, "estimated") == 0);
}

}  // namespace

TEST_CASE("The silhouette band explains what a shift across the ray does, and nothing else", "[tools][bench]") {
  const Scene scene = plate();
  const double width = 0.1;
  const auto band = [&](double x) { return silhouette_band(scene, down(x, 0.2), width); };
  // Inside: hits at a distance of 5, whichever way; a miss is not explained, nor is a hit far before or behind.
  CHECK_FALSE(band(0).any_miss);
  CHECK(band(0).nearest == Approx(5));
  CHECK(band(0).farthest == Approx(5));
  CHECK(band(0).explains(5.05, width));
  CHECK_FALSE(band(0).explains(5.2, width));
  CHECK_FALSE(band(0).explains(std::nullopt, width));
  // A little less than the width from the rim, on either side of it; then a little more.
  for (const double x : {0.901, 1.099}) {
    CHECK(band(x).explains(5.0, width));
    CHECK(band(x).explains(std::nullopt, width));
  }
  CHECK_FALSE(band(0.899).explains(std::nullopt, width));
  CHECK_FALSE(band(1.101).explains(5.0, width));
  // Only past the rim is anything let through, and only by the plate is anything near.
  CHECK(band(0.901).lets_through(7, width));
  CHECK_FALSE(band(0.899).lets_through(7, width));
  CHECK(band(0.899).lets_through(5.05, width));
  const Ray ray = down(0, 0.2);
  const Vec3 along = ray.direction.normalized();
  for (const double off : {-0.09, 0.09}) CHECK(is_near(scene, ray.origin + (5 + off) * along, along, width));
  for (const double off : {-0.11, 0.11}) CHECK_FALSE(is_near(scene, ray.origin + (5 + off) * along, along, width));
}

TEST_CASE("Two sheets that a ray grazes from opposite sides are missed each by itself", "[tools][bench]") {
  // Seen from above they overlap by 0.02, and no more if they are one folded sheet.
  const std::vector<Vec3> points{{-1, -1, 0},     {0.01, -1, 0}, {0.01, 1, 0}, {-1, 1, 0},
                                 {-0.01, -1, -2}, {1, -1, -2},   {1, 1, -2},   {-0.01, 1, -2}};
  const Scene two(mesh_of(points, {{0, 1, 2, 3}, {4, 5, 6, 7}}), "bilinear");
  const Scene folded(mesh_of(points, {{0, 1, 2, 3}, {2, 1, 4, 7}, {4, 5, 6, 7}}), "bilinear");
  const Ray ray = down(0, 0.2);  // meets z = 0 at a distance of 5, -2 at 7
  const double width = 0.1;
  for (const Scene* scene : {&two, &folded}) {
    const SilhouetteBand band = silhouette_band(*scene, ray, width);
    CHECK_FALSE(band.explains(std::nullopt, width));
    CHECK_FALSE(band.lets_through(8, width));
    CHECK(leads_past(*scene, ray, width) == (scene == &two));
    CHECK(leads_past(*scene, ray, width, 8) == (scene == &two));
    CHECK(leads_past(*scene, ray, width, 6));
  }
  CHECK(leads_past(two, ray, 0.011));
  CHECK_FALSE(leads_past(two, ray, 0.009));
  CHECK_FALSE(leads_past(plate(), ray, width));
  CHECK(leads_past(plate(), ray, width, 5.05));

  // An interval that is shorter than two widths may end before its chords begin.
  Ray brief = ray;
  for (const double half : {0.04, 0.06}) {  // in units of the direction's length, 2
    brief.tmin = 2.5 - half, brief.tmax = 2.5 + half;
    CHECK(leads_past(plate(), brief, width) == (half < 0.05));
  }

  const Contender chords{.kind = ContenderKind::chord, .chord = {.epsilon = 0.05, .min_size = 0}};  // a band of 0.1
  const std::vector<Ray> rays{ray};
  const Answers lost(1);
  CHECK(compare(chords, two, rays, trace(rays, two), lost).lost_outside == 0);
  CHECK(compare(chords, folded, rays, trace(rays, folded), lost).lost_outside == 1);
}

TEST_CASE("The band's width is that of epsilon or of the smallest patch that is refined", "[tools][bench]") {
  const ChordOptions options{.epsilon = 0.03, .min_size = 2};
  CHECK(band_width(options, {}, 7) == Approx(0.06));
  CHECK(band_width(options, {.width = 0.1, .growth = 0.01}, 7) == Approx(2 * 2 * 0.17));
}

TEST_CASE("Answers that are wrong are found, in the band and outside", "[tools][bench]") {
  const Scene scene = plate();
  const Contender chords{.kind = ContenderKind::chord, .chord = {.epsilon = 0.05, .min_size = 0}};  // a band of 0.1
  const std::vector<Ray> rays{down(0, 0), down(0.3, 0.1), down(0.95, 0), down(1.05, 0), down(3, 0), down(0.5, 0.5)};
  const Answers expected = trace(rays, scene);
  REQUIRE(expected[0]);
  REQUIRE_FALSE(expected[3]);
  CHECK(compare(chords, scene, rays, expected, expected).lost_outside == 0);

  Answers wrong = expected;
  wrong[0].reset();                    // lost in the middle
  wrong[1]->t += 0.5;                  // farther by 1 (the direction's length is 2)
  wrong[2].reset();                    // lost at the rim
  wrong[3] = wrong[4] = *expected[5];  // ghosts: beside the rim, and in nothing
  wrong[5]->normal = {0, std::sin(0.25), std::cos(0.25)};
  const ErrorFigures figures = compare(chords, scene, rays, expected, wrong);
  CHECK(figures.rays == 6);
  CHECK(figures.hits == 4);
  CHECK(figures.lost == 2);
  CHECK(figures.farther == 1);
  CHECK(figures.nearer == 0);
  CHECK(figures.ghosts == 2);
  CHECK(figures.lost_outside == 2);  // of lost and farther
  CHECK(figures.ghosts_outside == 1);
  CHECK(figures.outside.size() == 3);
  CHECK(figures.distance.max == Approx(1));
  CHECK(figures.normal.max == Approx(0.25));
}

TEST_CASE("Quantiles and spreads", "[tools][bench]") {
  std::vector<double> values;
  for (int i = 100; i >= 0; --i) values.push_back(i);
  const Quantiles of = quantiles(values);
  CHECK(of.median == 50);
  CHECK(of.p99 == 99);
  CHECK(of.max == 100);
  CHECK(spread({3, 1}).median == 2);
  CHECK(spread({5, 1, 3}).median == 3);
  CHECK(spread({5, 1, 3}).least == 1);
  CHECK(spread({5, 1, 3}).most == 5);
  LevelCounts counts;
  for (const int level : {1, 3, 3, 40}) counts.add(level);
  CHECK(counts.total() == 4);
  CHECK(counts.mean() == Approx((1 + 3 + 3 + 15) / 4.0));
}

TEST_CASE("The paper's tables add up to its means", "[tools][bench]") {
  for (const PaperScene& scene : paper_scenes())
    for (const PaperLevels& row : scene.levels) {
      double hits = 0, sum = 0;
      for (std::size_t i = 0; i < row.hits.size(); ++i) {
        hits += row.hits[i];
        sum += static_cast<double>(i + 1) * row.hits[i];
      }
      CAPTURE(scene.title, row.epsilon);
      CHECK(std::abs(sum / hits - row.mean) < 0.011);
    }
}

TEST_CASE("Random rays aim at the scene, ambient rays leave the side that is seen", "[tools][bench]") {
  const Subject subject(load_stage({data_file("torus.obj"), {}, {}}), {20, 20}, WarmRays::random_and_ambient_too);
  const Workload& work = subject.work;
  REQUIRE(work.random.size() == 400);
  const Box box = subject.exact.bounds();
  for (const Ray& ray : work.random) {
    CHECK((ray.origin - box.centre()).norm() == Approx(subject.diagonal));
    CHECK(ray.direction.norm() == Approx(1));
    CHECK(ray.footprint.growth == work.primary.front().footprint.growth);
  }
  std::size_t hits = 0;
  for (const auto& answer : subject.primary) hits += answer.has_value();
  REQUIRE(work.ambient.size() == hits);
  std::size_t next = 0;
  double cosines = 0;
  for (std::size_t i = 0; i < work.primary.size(); ++i) {
    if (!subject.primary[i]) continue;
    const Ray &primary = work.primary[i], &ambient = work.ambient[next++];
    const Vec3 normal = subject.primary[i]->normal;
    const double cosine = ambient.direction.dot(normal) * (normal.dot(primary.direction) <= 0 ? 1 : -1);
    CHECK(cosine >= 0);
    CHECK(ambient.tmax == Approx(subject.diagonal / 20));
    cosines += cosine;
  }
  // The mean by the cosine is 2/3, its deviation sqrt(1/18 / hits).
  CHECK(std::abs(cosines / static_cast<double>(hits) - 2.0 / 3) < 4 * std::sqrt(1.0 / 18 / static_cast<double>(hits)));
}

TEST_CASE("Peak memory includes what is freed again", "[tools][bench]") {
  const std::size_t size = std::size_t{64} << 20;
  const PeakMemory memory;
  { const std::vector<char> held(size, 1); }
  CHECK(memory.growth() > size - size / 16);  // the system counts pages in batches
  CHECK(PeakMemory().growth() < size / 2);
}

// Regular patches, and rounded corners, n-gons, creases, darts and points near irregular vertices.
TEST_CASE("Refinement in quadruple precision finds the limit", "[tools][bench]") {
  Random random(11);
  for (const std::string name : {"torus.obj", "ngon_body.obj", "cube_creases.obj", "dart.obj", "loop_torus.obj"}) {
    const LoadedModel model = load_model({data_file(name), {}, {}});
    const QuadOracle oracle(model.mesh, model.scheme);
    const auto surface = make_limit_surface(model.mesh, model.scheme);
    for (int i = 0; i < 12; ++i) {
      const int face = random.index(surface->face_count()), sub = random.index(surface->sub_count(face));
      const double u = random.uniform(0, i % 3 == 0 ? 1e-3 : 0.5), v = random.uniform(0, 0.5);
      const SurfaceParameter at{face, sub, u, v};
      const auto sample = surface->evaluate(at);
      if (!sample) continue;
      CAPTURE(name, face, sub, at.u, at.v);
      const QuadVec3 difference = oracle.position(at) - sample->position.cast<Quad>();
      CHECK(static_cast<double>(difference.norm()) < 1e-15 * oracle.diagonal());
    }
  }
}

// A pyramid of n faces around vertex 0 at z = 1, the rest at z = 0 but vertex 1 at z = 1: the limit weighs the vertex
// 1 - n w and its neighbours w = 1 / (n + 3 / (8 beta)), which no double holds.
TEST_CASE("Refinement in quadruple precision has more digits than double", "[tools][bench]") {
  for (const int n : {5, 6}) {
    std::vector<Vec3> points{{0, 0, 1}};
    std::vector<std::vector<int>> faces;
    for (int i = 0; i < n; ++i) {
      const double angle = 2 * std::numbers::pi * i / n;
      points.emplace_back(std::cos(angle), std::sin(angle), i == 0 ? 1 : 0);
      faces.push_back({0, 1 + i, 1 + (i + 1) % n});
    }
    const QuadVec3 limit = QuadOracle(mesh_of(points, faces), "loop").position({0, 0, 0, 0});
    const Quad cosine = n == 6 ? Quad(1) / 2 : (sqrt(Quad(5)) - 1) / 4;  // of 2 pi / n
    const Quad root = Quad(3) / 8 + cosine / 4, beta = (Quad(5) / 8 - root * root) / n;
    const Quad weight = 1 / (n + 3 / (8 * beta));
    CAPTURE(n);
    CHECK(static_cast<double>(abs(limit.z() - (1 - n * weight + weight))) < 1e-25);
  }
}

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

TEST_CASE("bench paper counts every hit once, and its files can be read", "[tools][cli][bench]") {
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
    if (levels.text(i, "method").starts_with("Uniform"))
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

TEST_CASE("bench pareto measures every phase of several scenes", "[tools][cli][bench]") {
  const Folder folder;
  const Outcome outcome =
      folder.run({"bench", "pareto", data_file("torus.obj"), data_file("loop_torus.obj"), "--size", "40x40", "--runs",
                  "2", "--level", "4", "--exact-hits", "20", "--report", folder / "out"});
  CAPTURE(outcome.text);
  REQUIRE(outcome.status == 0);
  CHECK(outcome.text.find("Embree's subdivision is left out: Embree subdivides by Catmull-Clark alone") !=
        std::string::npos);
  const Table errors(folder / "out/errors.csv"), times(folder / "out/times.csv"), exact(folder / "out/exact.csv");
  const std::size_t without_subdivision = 1 + 2 * 9 + 2 * 4;
  CHECK(errors.rows.size() == 2 * without_subdivision + 4);
  check_errors(errors);
  REQUIRE(times.rows.size() == errors.rows.size());
  for (std::size_t i = 0; i < times.rows.size(); ++i) {
    CAPTURE(times.rows[i]);
    check_times(times, i, 2);
    for (const std::string phase : {"random", "ambient"}) CHECK(times.number(i, phase) > 0);
    CHECK(times.number(i, "peak_bytes") > 0);
  }

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
  for (const char* text : {"99th percentile", "<h2>torus", "<h2>loop_torus", "memory against", "Embree subdivision"})
    CHECK(page.find(text) != std::string::npos);
  CHECK(page.find("nan") == std::string::npos);
  const Json json = read_json(folder / "out/pareto.json");
  REQUIRE(json.at("scenes").size() == 2);
  std::size_t row = 0;
  for (const Json& scene : json.at("scenes")) {
    CHECK(scene.contains("embree_subdivision_left_out") == (scene.at("scene") == "loop_torus"));
    CHECK(scene.at("rays").at("primary") == 1600);
    CHECK(scene.at("rays").at("random") == 1600);
    for (const Json& one : scene.at("measurements")) {
      CHECK(one.at("method") == times.text(row, "method"));
      CHECK(one.at("seconds").at("cold").at("median") == times.number(row, "cold"));
      CHECK(one.at("errors").at("distance").at("p99") == errors.number(row, "distance_p99"));
      ++row;
    }
  }
  CHECK(row == times.rows.size());
}

TEST_CASE("bench lost counts its rays, and fails if it lists any", "[tools][cli][bench]") {
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
           {"bench", "pareto", torus, "--report", report, "--unit", "0"},
           {"bench", "pareto", torus, "--report", report, "--unit", "nan"},
           {"bench", "lost"},
           {"bench", "lost", torus, "--rays", "0"},
           {"bench", "lost", torus, "--epsilon", "-1"},
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
           {"bench", "lost", folder / "nothing.obj"},
       }) {
    CAPTURE(bad);
    const Outcome outcome = folder.run(bad);
    CHECK(outcome.status == 3);
    CHECK(outcome.text.find("shaolin: error: ") != std::string::npos);
  }
}

}  // namespace shaolin::test
