// `shaolin stress`: sound answers pass, and each fault that is planted is counted as what it is.
#include <oneapi/tbb/task_arena.h>

#include <bit>
#include <nlohmann/json.hpp>

#include "schemes/errors.h"
#include "tests/catch.h"
#include "tests/tools/cli_run.h"
#include "tools/stress/bad_numbers.h"
#include "tools/stress/meshes.h"
#include "tools/stress/report.h"
#include "tools/stress/run.h"

namespace shaolin::stress {

using test::data_file;
using test::Folder;
using test::Outcome;
using test::read_file;
using test::read_rows;

namespace {

/// About one ray in eight, by its own bits: whatever the order of rays.
bool is_chosen(const Ray& ray) {
  const auto bits = std::bit_cast<std::uint64_t>(ray.direction.x() + ray.origin.y());
  return (bits * 0x9e3779b97f4a7c15) >> 61 == 0;
}

/// Scene's answers with the closest hits of some rays spoilt; any hit follows.
template <class Spoil>
QueriesOf with_closest(Spoil spoil) {
  return [spoil](const Scene& scene) {
    RayQueries queries = RayQueries::of(scene);
    queries.intersect = [&scene, spoil](const Ray& ray) {
      std::optional<Hit> hit = scene.intersect(ray);
      if (hit && is_chosen(ray)) spoil(hit);
      return hit;
    };
    queries.occluded = [ask = queries.intersect](const Ray& ray) { return ask(ray).has_value(); };
    return queries;
  };
}

/// The same of all hits, where there are any.
template <class Spoil>
QueriesOf with_all(Spoil spoil) {
  return [spoil](const Scene& scene) {
    RayQueries queries = RayQueries::of(scene);
    queries.all_hits = [&scene, spoil](const Ray& ray) {
      std::vector<Crossing> all = scene.all_hits(ray);
      if (!all.empty() && is_chosen(ray)) spoil(all);
      return all;
    };
    return queries;
  };
}

Result run_with(const QueriesOf& queries_of, std::vector<std::string> families, std::size_t rays = 128) {
  return run({.models = {sound_models().front(), sound_models()[1]},
              .families = std::move(families),
              .rays = rays,
              .queries_of = queries_of});
}

const std::vector<std::string> general{"vertices",   "edges",       "lines",      "inside",   "grazing",
                                       "translated", "far origins", "watertight", "permuted", "spawned"};

/// Meshes on which a ray may take a second.
bool is_slow(const std::string& family) {
  return family == "degenerate" || family == "valences" || family == "translated";
}

std::string first_failure(const Result& result) {
  for (const Row& row : result.rows)
    for (const Failure& failure : row.tally.failures) return row.family + ' ' + row.model + ' ' + failure.detail;
  return "none";
}

}  // namespace

TEST_CASE("stress finds nothing wrong with sound answers", "[tools][stress]") {
  std::vector<std::string> quick;
  for (const Family& family : families())
    if (!is_slow(family.name)) quick.push_back(family.name);
  const Result result = run({.models = sound_models(), .families = quick, .rays = 8});
  INFO(first_failure(result));
  CHECK(result.total().passed());
  CHECK(result.by_family().size() == quick.size());
  CHECK(result.total().hits > result.total().rays / 2);
  CHECK(result.total().worst_error > 0);
  CHECK(result.total().worst_error < 2688);  // 12 times 224, see check.cpp
  CHECK(result.slowdown > 0);
}

TEST_CASE("stress finds nothing wrong with degenerate meshes and high valences", "[tools][stress][sweep]") {
  const Result result =
      run({.models = sound_models(), .families = {"degenerate", "valences", "translated"}, .rays = 4});
  INFO(first_failure(result));
  CHECK(result.total().passed());
  CHECK(result.total().hits > result.total().rays / 3);
}

TEST_CASE("stress counts lost hits, in each family", "[tools][stress][sweep]") {
  for (const std::string& family : general) {
    CAPTURE(family);
    const Result result = run_with(with_closest([](std::optional<Hit>& hit) { hit.reset(); }), {family});
    const Tally total = result.total();
    CHECK(total.count(Fault::lost) > 0);
    CHECK(total.count(Fault::lost) < total.rays / 2);
    CHECK(total.count(Fault::ghost) == 0);
    CHECK(total.count(Fault::duplicate) == 0);
    CHECK_FALSE(result.passed());
    CHECK(is_chosen(result.rows.front().tally.failures.empty() ? result.rows.back().tally.failures.front().ray
                                                               : result.rows.front().tally.failures.front().ray));
  }
}

TEST_CASE("stress counts hits that are lost among all hits", "[tools][stress]") {
  for (const bool first : {true, false}) {
    const auto drop = [first](std::vector<Crossing>& all) { all.erase(first ? all.begin() : all.end() - 1); };
    const Tally total = run_with(with_all(drop), {"vertices", "lines", "watertight"}).total();
    CHECK(total.count(Fault::lost) > 20);
    CHECK(total.count(Fault::ghost) == 0);
    CHECK(total.count(Fault::duplicate) == 0);
  }
}

TEST_CASE("stress counts ghosts: off the surface, off the ray, elsewhere in parameters", "[tools][stress]") {
  const std::vector<std::function<void(Hit&)>> spoilers{
      [](Hit& hit) { hit.sample.position.x() += 1e-9 * std::max(1.0, hit.sample.position.norm()); },
      [](Hit& hit) { hit.t *= 1 - 1e-9; }, [](Hit& hit) { hit.at.u = 0.5 * hit.at.u + 1e-7; },
      [](Hit& hit) { hit.at.face = -1; }, [](Hit& hit) { hit.sample.normal *= 1.01; }};
  for (std::size_t i = 0; i < spoilers.size(); ++i) {
    CAPTURE(i);
    const auto spoil = [&](std::optional<Hit>& hit) { spoilers[i](*hit); };
    const Tally closest = run_with(with_closest(spoil), {"vertices", "lines"}).total();
    CHECK(closest.count(Fault::ghost) > 20);
    CHECK(closest.count(Fault::duplicate) == 0);
    const auto spoil_all = [&](std::vector<Crossing>& all) { spoilers[i](all.back().hit); };
    CHECK(run_with(with_all(spoil_all), {"vertices", "lines"}).total().count(Fault::ghost) > 20);
  }
}

TEST_CASE("stress counts crossings that are reported twice", "[tools][stress]") {
  const auto twice = [](std::vector<Crossing>& all) { all.insert(all.begin(), all.front()); };
  const Tally total = run_with(with_all(twice), {"vertices", "edges", "lines"}).total();
  CHECK(total.count(Fault::duplicate) > 20);
  CHECK(total.count(Fault::ghost) == 0);
  // With a touch nothing is wrong but at a vertex or an edge.
  const auto touch_too = [](std::vector<Crossing>& all) {
    for (std::size_t i = 0; i < all.size(); i += 2)
      all.insert(all.begin() + static_cast<std::ptrdiff_t>(i), {all[i].hit, Sense::touches});
  };
  CHECK(run_with(with_all(touch_too), {"vertices"}).total().count(Fault::duplicate) > 10);
}

TEST_CASE("stress counts answers to rays that are none", "[tools][stress]") {
  const auto accepting = [](const Scene& scene) {
    RayQueries queries = RayQueries::of(scene);
    queries.intersect = [&scene](const Ray& ray) -> std::optional<Hit> {
      if (!ray.origin.allFinite()) return {};
      return scene.intersect(ray);
    };
    return queries;
  };
  CHECK(run_with(accepting, {"bad numbers"}).total().count(Fault::ghost) > 0);
  const auto refusing = [](const Scene& scene) {
    RayQueries queries = RayQueries::of(scene);
    queries.all_hits = [](const Ray&) -> std::vector<Crossing> { throw InputError("no"); };
    return queries;
  };
  CHECK(run_with(refusing, {"lines"}).total().count(Fault::ghost) > 0);
}

TEST_CASE("stress notices that bad numbers take long", "[tools][stress]") {
  const auto slow = [](const Scene& scene) {
    RayQueries queries = RayQueries::of(scene);
    queries.intersect = [&scene](const Ray& ray) {
      for (int i = 0; i < 100 && !(ray.origin.allFinite() && ray.direction.allFinite()); ++i)
        scene.intersect({Vec3(5, 0, 0), Vec3(-1, 0, 0)});
      return scene.intersect(ray);
    };
    return queries;
  };
  CHECK(bad_number_slowdown(slow) > Result::most_slowdown);
}

TEST_CASE("stress throws the same rays on any number of threads, and at first those of a shorter run",
          "[tools][stress]") {
  const auto faulty = with_closest([](std::optional<Hit>& hit) { hit.reset(); });
  const auto on_threads = [&](int threads, std::size_t rays) {
    Result result;
    tbb::task_arena(threads).execute([&] { result = run_with(faulty, {"vertices", "lines"}, rays); });
    return result;
  };
  const Result one = on_threads(1, 200), two = on_threads(2, 200), shorter = on_threads(2, 100);
  REQUIRE(one.rows.size() == two.rows.size());
  for (std::size_t i = 0; i < one.rows.size(); ++i) {
    const Tally &a = one.rows[i].tally, &b = two.rows[i].tally, &c = shorter.rows[i].tally;
    CHECK(a.hits == b.hits);
    CHECK(a.wrong == b.wrong);
    CHECK(a.worst_error == b.worst_error);
    REQUIRE(a.failures.size() == b.failures.size());
    REQUIRE(c.failures.size() < a.failures.size());
    for (std::size_t k = 0; k < a.failures.size(); ++k) {
      CHECK(a.failures[k].ray.origin == b.failures[k].ray.origin);
      if (k < c.failures.size()) CHECK(a.failures[k].ray.direction == c.failures[k].ray.direction);
    }
  }
}

TEST_CASE("All faces at an edge or a vertex name the same point", "[tools][stress]") {
  for (const StressModel& model : sound_models()) {
    CAPTURE(model.name);
    const Subject subject(model, RayQueries::of);
    const Sites& sites = subject.sites();
    CHECK(sites.vertices.size() == model.mesh.positions.size());
    double apart = 0;
    for (const EdgeSite& edge : sites.edges)
      for (const double along : {0.0, 0.25, 0.7, 1.0}) {
        const Vec3 first = subject.evaluate(on_edge(subject.surface(), edge.sides.front(), along)).position;
        for (const EdgeSite::Side& side : edge.sides)
          apart = std::max(apart, (subject.evaluate(on_edge(subject.surface(), side, along)).position - first).norm());
      }
    for (const VertexSite& vertex : sites.vertices)
      for (const SurfaceParameter& at : vertex)
        apart = std::max(apart, (subject.evaluate(at).position - subject.evaluate(vertex.front()).position).norm());
    CHECK(apart < 1e-14 * 16);
  }
}

TEST_CASE("stress writes tables and failures", "[tools][stress]") {
  const Folder folder;
  const Result result = run_with(with_closest([](std::optional<Hit>& hit) { hit.reset(); }), {"vertices"});
  write_report(folder / "report", result, {});
  const auto rows = read_rows(folder / "report" / "failures.csv");
  CHECK(rows.size() == 1 + result.total().count(Fault::lost));
  for (const auto& row : rows) REQUIRE(row.size() == rows.front().size());
  const Ray& ray = result.rows.front().tally.failures.front().ray;
  CHECK(std::stod(rows[1][4]) == ray.origin.x());
  CHECK(std::stod(rows[1][9]) == ray.direction.z());
  const auto json = nlohmann::json::parse(read_file(folder / "report" / "stress.json"));
  CHECK(json["passed"] == false);
  CHECK(json["total"]["lost"] == result.total().count(Fault::lost));
  CHECK(json["failures"].size() == result.total().count(Fault::lost));
  CHECK(json["failures"][0]["ray"]["origin"][1] == ray.origin.y());
}

TEST_CASE("The subcommand stress: models, families, reports, exit statuses", "[tools][stress]") {
  const Folder folder;
  const std::vector<std::string> arguments{"stress",   data_file("torus.obj"), "--rays", "64", "--family", "vertices",
                                           "--family", "watertight",           "--seed", "7"};
  const Outcome first = folder.run(arguments), again = folder.run(arguments);
  INFO(first.text);
  CHECK(first.status == 0);
  CHECK(first.text == again.text);
  CHECK(first.text.find("| vertices ") != std::string::npos);
  CHECK(first.text.find("PASS") != std::string::npos);
  CHECK(first.text.find("--seed 7 --rays 64") != std::string::npos);

  const Outcome timed = folder.run(
      {"stress", data_file("torus.obj"), "--minutes", "0.02", "--family", "lines", "--report", folder / "report"});
  INFO(timed.text);
  CHECK(timed.status == 0);
  CHECK(read_rows(folder / "report" / "stress.csv").size() == 2);

  CHECK(folder.run({"stress", "--rays", "0"}).status == 2);
  CHECK(folder.run({"stress", "--rays", "5", "--minutes", "1"}).status == 2);
  CHECK(folder.run({"stress", "--family", "unknown"}).status == 2);
  CHECK(folder.run({"stress", folder / "missing.obj"}).status == 3);
}

}  // namespace shaolin::stress
