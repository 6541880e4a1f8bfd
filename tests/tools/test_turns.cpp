/// `bench`: contenders that take turns.
#include "tests/catch.h"
#include "tests/tools/cli_run.h"
#include "tools/bench/peer_ratios.h"
#include "tools/bench/timed_run.h"
#include "tools/bench/turns.h"

namespace shaolin::test {
namespace {

/// Hits every ray whose tmin is even, and writes down who was asked for which ray.
class Witness final : public Tracer {
 public:
  Witness(char name, std::vector<std::pair<char, int>>& log) : name_(name), log_(log) {}

  std::optional<Answer> intersect(const Ray& ray) const override {
    return occluded(ray) ? std::optional<Answer>(Answer{}) : std::nullopt;
  }
  bool occluded(const Ray& ray) const override {
    const int number = static_cast<int>(ray.tmin);
    log_.emplace_back(name_, number);
    return number % 2 == 0;
  }
  std::size_t bytes() const override { return 0; }

 private:
  char name_;
  std::vector<std::pair<char, int>>& log_;
};

Subject small_subject(const std::string& model) {
  return Subject(load_stage({data_file(model), {}, {}}), {24, 24}, WarmRays::random_and_ambient_too);
}

}  // namespace

TEST_CASE("Tracers take turns chunk by chunk, each after the chunk before, which does not count", "[tools][bench]") {
  std::vector<std::pair<char, int>> log;
  const Witness a('a', log), b('b', log);
  const std::vector<const Tracer*> both{&a, &b};
  std::vector<Ray> rays(5);
  for (std::size_t i = 0; i < rays.size(); ++i) rays[i].tmin = static_cast<double>(i);
  const Query query = GENERATE(Query::intersect, Query::occluded);
  const std::size_t chunk = GENERATE(std::size_t{2}, chunk_rays);  // of few rays a quarter, rounded up
  const std::vector<Lap> laps = trace_in_turns(both, rays, query, chunk);
  std::string asked;
  for (const auto& [name, number] : log) asked += name + std::to_string(number) + ' ';
  CHECK(asked ==
        "a4 a0 a1 b4 b0 b1 "
        "a0 a1 a2 a3 b0 b1 b2 b3 "
        "a2 a3 a4 b2 b3 b4 ");
  REQUIRE(laps.size() == 2);
  for (const Lap& lap : laps) {
    CHECK(lap.hits == 3);
    CHECK(lap.seconds > 0);
  }
  CHECK(trace_in_turns(both, {}, query, chunk).at(1).hits == 0);
}

TEST_CASE("Turns answer as the whole does, whatever the chunk", "[tools][bench]") {
  const Subject subject = small_subject("torus.obj");
  std::vector<std::unique_ptr<Tracer>> scenes;
  std::vector<const Tracer*> tracers;
  for (const Contender& contender : {Contender{}, Contender{.kind = ContenderKind::subdivision, .level = 3},
                                     Contender{.kind = ContenderKind::uniform, .level = 2}}) {
    scenes.push_back(make_tracer(contender, subject.stage));
    tracers.push_back(scenes.back().get());
  }
  const std::size_t chunk = GENERATE(1, 7, 100, chunk_rays);
  const std::vector<Lap> hits = trace_in_turns(tracers, subject.work.random, Query::intersect, chunk);
  const std::vector<Lap> stops = trace_in_turns(tracers, subject.work.shadow, Query::occluded, chunk);
  for (std::size_t i = 0; i < tracers.size(); ++i) {
    CHECK(hits[i].hits == trace_once(*tracers[i], subject.work.random, Query::intersect).hits);
    CHECK(stops[i].hits == trace_once(*tracers[i], subject.work.shadow, Query::occluded).hits);
    CHECK(hits[i].hits > 200);
  }
}

TEST_CASE("A timed run has each phase once, and must answer as was verified", "[tools][bench]") {
  const Subject subject = small_subject("torus.obj");
  const std::vector<Contender> contenders{{},
                                          {.kind = ContenderKind::subdivision, .level = 3},
                                          {.kind = ContenderKind::triangles, .level = 1},
                                          {.kind = ContenderKind::triangles, .level = 2}};
  // Room for all together, or for each alone.
  const std::size_t room = GENERATE(std::size_t{1} << 30, std::size_t{300000});
  std::vector<Measurement> results = measure(subject, contenders, {.runs = 2, .most_bytes = room});
  REQUIRE(results.size() == 4);
  const auto exact_hits = static_cast<std::size_t>(
      std::count_if(subject.random.begin(), subject.random.end(), [](const auto& one) { return one.has_value(); }));
  for (const Measurement& one : results) {
    CAPTURE(one.contender.name(), one.fault, one.bytes);
    REQUIRE(one.fault.empty());
    if (one.estimated) {
      CHECK(room == 300000);
      continue;
    }
    for (const Phase phase : phases) {
      const bool expected = phase != Phase::tessellation || one.contender.kind == ContenderKind::triangles;
      CHECK(one.times(phase).size() == (expected ? 2 : 0));
      for (const double seconds : one.times(phase)) CHECK(seconds > 0);
    }
    for (std::size_t run = 0; run < 2; ++run)
      CHECK(one.times(Phase::cold)[run] >
            one.times(Phase::build)[run] +
                (one.is_timed(Phase::tessellation) ? one.times(Phase::tessellation)[run] : 0));
    CHECK(one.random_errors.rays == 24 * 24);
    CHECK(one.random_errors.hits == exact_hits);
    CHECK(one.ambient_errors.rays == subject.work.ambient.size());
    const bool is_exact = one.contender.kind == ContenderKind::exact;
    CHECK((one.random_errors.distance.median > 0) == !is_exact);
    CHECK((one.random_errors.normal.max > 0) == !is_exact);
    if (is_exact) CHECK(one.ambient_errors.lost + one.ambient_errors.ghosts == 0);
  }
  ++results[0].random_errors.ghosts;
  std::vector<Measurement*> spoilt{&results[0]};
  CHECK_THROWS_AS(time_run(subject, spoilt), std::runtime_error);
}

TEST_CASE("Ratios over the peer are run by run", "[tools][bench]") {
  const auto measured = [](ContenderKind kind, int level, double scale, std::size_t bytes) {
    Measurement one{.contender = {.kind = kind, .level = level}};
    one.bytes = bytes;
    for (const Phase phase : phases)
      if (phase != Phase::tessellation || kind == ContenderKind::triangles)
        one.seconds[static_cast<std::size_t>(phase)] = {scale, 3 * scale, 2 * scale};
    return one;
  };
  ParetoResult result{.scene = "ball"};
  result.diagonal = 4;
  result.exact.hits = 10;
  result.exact.along.max = 2e-15;
  result.measurements = {measured(ContenderKind::exact, 0, 2, 30), measured(ContenderKind::triangles, 3, 1, 60),
                         measured(ContenderKind::triangles, 4, 1, 60)};
  Measurement& exact = result.measurements[0];
  exact.seconds[static_cast<std::size_t>(Phase::cold)] = {8, 8, 8};
  Measurement& peer = result.measurements[1];
  peer.seconds[static_cast<std::size_t>(Phase::cold)] = {2, 4, 16};
  peer.seconds[static_cast<std::size_t>(Phase::tessellation)] = {1, 2, 12};
  peer.seconds[static_cast<std::size_t>(Phase::shadow)] = {};

  const std::vector<PeerRatios> ratios = ratios_over_peers(result);
  REQUIRE(ratios.size() == 2);
  CHECK(ratios[0].memory == 0.5);
  const auto& times = ratios[0].times;
  REQUIRE(times[0]);
  CHECK(times[0]->least == 0.5);
  CHECK(times[0]->median == 2);
  CHECK(times[0]->most == 4);
  REQUIRE(times[1]);  // without tessellation: 1, 2, 4
  CHECK(times[1]->least == 2);
  CHECK(times[1]->median == 4);
  CHECK(times[1]->most == 8);
  CHECK(times[2]->median == 2);
  CHECK_FALSE(times[4]);

  const auto level_3 = bar_table({result});
  REQUIRE(level_3.rows.size() == 1);
  CHECK(level_3.rows[0] == std::vector<std::string>{"ball", "Embree triangles, level 3", "2 (0.5 to 4)", "4 (2 to 8)",
                                                    "2 (2 to 2)", "2 (2 to 2)", "", "2 (2 to 2)", "0.5", "5e-16"});
  CHECK(level_3.header.size() == level_3.rows[0].size());
  // Where Embree's own subdivision was timed it is what counts.
  result.measurements.push_back(measured(ContenderKind::subdivision, 5, 4, 15));
  const auto level_5 = bar_table({result});
  REQUIRE(level_5.rows.size() == 1);
  CHECK(level_5.rows[0][1] == "Embree subdivision, level 5");
  CHECK(level_5.rows[0][3].empty());
  CHECK(level_5.rows[0][8] == "2");
  CHECK(ratio_table(result).rows.size() == 3);
}

}  // namespace shaolin::test
