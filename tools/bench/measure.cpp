#include "tools/bench/measure.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_reduce.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <utility>

#include "tools/bench/peak_memory.h"
#include "tools/cli/framing.h"
#include "tools/cli/render_stats.h"
#include "tools/cli/threads.h"

namespace shaolin {
namespace {

Scene build_copy(Stage stage) { return build_scene(stage); }

Workload work_of(const Scene& exact, const View& view, const Look& look, WarmRays warm) {
  Workload work = make_workload(exact, view, look);
  if (warm == WarmRays::random_and_ambient_too) add_random_and_ambient_rays(exact, work);
  return work;
}

LevelCounts count_levels(const Answers& answers) {
  LevelCounts counts;
  for (const auto& answer : answers)
    if (answer) counts.add(answer->level);
  return counts;
}

std::size_t count_hits(const Tracer& tracer, std::span<const Ray> rays) {
  return static_cast<std::size_t>(
      std::count_if(rays.begin(), rays.end(), [&](const Ray& ray) { return tracer.intersect(ray).has_value(); }));
}

std::size_t count_occluded(const Tracer& tracer, std::span<const Ray> rays) {
  return static_cast<std::size_t>(
      std::count_if(rays.begin(), rays.end(), [&](const Ray& ray) { return tracer.occluded(ray); }));
}

std::size_t count_disagreements(const Tracer& tracer, std::span<const Ray> rays, const Answers& answers) {
  return tbb::parallel_reduce(
      tbb::blocked_range<std::size_t>(0, rays.size(), 1024), std::size_t{0},
      [&](const auto& range, std::size_t count) {
        for (std::size_t i = range.begin(); i != range.end(); ++i)
          count += tracer.occluded(rays[i]) != answers[i].has_value();
        return count;
      },
      std::plus<>());
}

/// A wrong mesh, transform or scheme is wrong by far more than this: outlines by a few in a hundred pixels, depths by a
/// few thousandths of the scene. Coarse triangles are off by four times as much for each level less than three.
/// Of ambient occlusion nothing is asked: its rays start in the hollows between coarse triangles and the surface.
std::string fault_of(const Measurement& measurement, double diagonal) {
  const Contender& contender = measurement.contender;
  const ErrorFigures& errors = measurement.errors;
  // Chords are as coarse as epsilon and the size of pixels ask for.
  const double coarse = contender.is_adaptive()                         ? 4
                        : contender.is_uniform() && contender.level < 3 ? std::pow(4.0, 3 - contender.level)
                                                                        : 1;
  const auto too_many = [&](std::size_t wrong, std::size_t hits) {
    return static_cast<double>(wrong) > 0.03 * coarse * static_cast<double>(hits) + 4;
  };
  if (too_many(errors.lost + errors.ghosts, errors.hits))
    return std::to_string(errors.lost) + " lost and " + std::to_string(errors.ghosts) + " ghost hits of " +
           std::to_string(errors.hits);
  if (errors.distance.median > 2e-3 * coarse * diagonal)
    return "a median error of " + std::to_string(errors.distance.median) + " along the ray";
  if (too_many(measurement.random_differs, measurement.random_hits))
    return std::to_string(measurement.random_differs) + " of the random rays hit or miss otherwise, " +
           std::to_string(measurement.random_hits) + " hit";
  return {};
}

Measurement answer(const Subject& subject, const Contender& contender) {
  Measurement result{.contender = contender};
  const auto tracer = make_tracer(contender, subject.stage);
  const Answers primary = trace(subject.work.primary, *tracer), shadow = trace(subject.work.shadow, *tracer);
  const Answers random = trace(subject.work.random, *tracer);
  for (std::size_t i = 0; i < random.size(); ++i) {
    result.random_hits += random[i].has_value();
    result.random_differs += random[i].has_value() != subject.random[i].has_value();
  }
  result.ambient_hits = count_occluded(*tracer, subject.work.ambient);
  result.bytes = tracer->bytes();
  result.primary = count_levels(primary);
  result.shadow = count_levels(shadow);
  result.occluded_differs = count_disagreements(*tracer, subject.work.shadow, shadow);

  std::vector<Ray> rays = subject.work.primary;
  rays.insert(rays.end(), subject.work.shadow.begin(), subject.work.shadow.end());
  const auto joined = [](Answers first, const Answers& second) {
    first.insert(first.end(), second.begin(), second.end());
    return first;
  };
  result.errors =
      compare(contender, subject.exact, rays, joined(subject.primary, subject.shadow), joined(primary, shadow));
  result.fault = fault_of(result, subject.diagonal);
  return result;
}

/// Throws std::runtime_error if a timed run's hits are not those that were verified.
void expect_hits(const Measurement& verified, std::size_t hits, std::size_t expected, std::size_t slack = 0) {
  if (std::max(hits, expected) - std::min(hits, expected) > slack)
    throw std::runtime_error(verified.contender.name() + " answers otherwise when it is timed");
}

/// One run's times, appended; see Phase.
void time_once(const Subject& subject, Measurement& result) {
  const PeakMemory memory;
  Stopwatch stopwatch;
  const auto add = [&](Phase phase, double seconds) {
    result.seconds[static_cast<std::size_t>(phase)].push_back(seconds);
  };
  const auto tracer = make_tracer(result.contender, subject.stage);
  const double build = stopwatch.lap();
  const auto primary = [&] { expect_hits(result, count_hits(*tracer, subject.work.primary), result.primary.total()); };
  const auto shadow = [&] {
    expect_hits(result, count_occluded(*tracer, subject.work.shadow), result.shadow.total(), result.occluded_differs);
  };
  const auto random = [&] { expect_hits(result, count_hits(*tracer, subject.work.random), result.random_hits); };
  const auto ambient = [&] { expect_hits(result, count_occluded(*tracer, subject.work.ambient), result.ambient_hits); };
  const auto time_warm = [&](Phase phase, const auto& trace_rays) {
    stopwatch.lap();
    trace_rays();
    add(phase, stopwatch.lap());
  };
  primary();
  shadow();
  add(Phase::build, build);
  add(Phase::cold, build + stopwatch.lap());
  time_warm(Phase::camera, primary);
  time_warm(Phase::shadow, shadow);
  if (!subject.work.random.empty()) {
    random();
    time_warm(Phase::random, random);
  }
  if (!subject.work.ambient.empty()) {
    ambient();
    time_warm(Phase::ambient, ambient);
  }
  result.peak_bytes = std::max(result.peak_bytes, memory.growth());
}

}  // namespace

void LevelCounts::add(int level) { ++hits[std::min(static_cast<std::size_t>(std::max(level, 0)), levels - 1)]; }

std::uint64_t LevelCounts::total() const {
  std::uint64_t sum = 0;
  for (const std::uint64_t count : hits) sum += count;
  return sum;
}

double LevelCounts::mean() const {
  double sum = 0;
  for (std::size_t level = 0; level < levels; ++level) sum += static_cast<double>(level * hits[level]);
  return total() > 0 ? sum / static_cast<double>(total()) : 0;
}

LevelCounts Measurement::levels() const {
  LevelCounts both = primary;
  for (std::size_t level = 0; level < LevelCounts::levels; ++level) both.hits[level] += shadow.hits[level];
  return both;
}

const char* name_of(Phase phase) {
  constexpr std::array names{"build", "cold", "camera", "shadow", "random", "ambient"};
  static_assert(names.size() == phases.size());
  return names[static_cast<std::size_t>(phase)];
}

Spread spread(std::vector<double> values) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return {(values[(n - 1) / 2] + values[n / 2]) / 2, values.front(), values.back()};
}

Spread ratio(const Measurement& a, const Measurement& b, Phase phase) {
  std::vector<double> ratios;
  for (std::size_t run = 0; run < std::min(a.times(phase).size(), b.times(phase).size()); ++run)
    ratios.push_back(a.times(phase)[run] / b.times(phase)[run]);
  return spread(ratios);
}

Subject::Subject(Stage of, ImageSize size, WarmRays warm)
    : stage(std::move(of)),
      exact(build_copy(stage)),
      view(choose_camera(stage, exact, size), size),
      work(work_of(exact, view, stage.scene.look, warm)),
      primary(trace(work.primary, exact)),
      shadow(trace(work.shadow, exact)),
      random(trace(work.random, exact)),
      diagonal((exact.bounds().upper - exact.bounds().lower).norm()) {}

std::vector<Measurement> measure(const Subject& subject, std::span<const Contender> contenders,
                                 const MeasureOptions& options) {
  std::vector<Measurement> results;
  for (const Contender& contender : contenders) {
    const auto coarser = std::find_if(results.begin(), results.end(), [&](const Measurement& known) {
      return contender.is_uniform() && known.contender.kind == contender.kind &&
             known.contender.level == contender.level - 1;
    });
    if (coarser != results.end() && 4 * coarser->bytes > options.most_bytes) {
      const std::size_t bytes = 4 * coarser->bytes;
      results.push_back({.contender = contender, .bytes = bytes, .estimated = true});
      continue;
    }
    results.push_back(answer(subject, contender));
    const Measurement& done = results.back();
    std::printf("  %-32s mean level %.2f, %zu lost, %zu ghosts%s%s\n", contender.name().c_str(), done.levels().mean(),
                done.errors.lost, done.errors.ghosts, done.fault.empty() ? "" : ": not timed: ", done.fault.c_str());
    std::fflush(stdout);
  }
  for (int run = 0; run < options.runs; ++run)
    for (Measurement& result : results)
      if (!result.estimated && result.fault.empty()) run_with_threads(1, [&] { time_once(subject, result); });
  return results;
}

std::size_t bytes_after(const Contender& contender, const Subject& subject, const Stage& stage) {
  const auto tracer = make_tracer(contender, stage);
  trace(subject.work.primary, *tracer);
  trace(subject.work.shadow, *tracer);
  return tracer->bytes();
}

Stage without_sharing(const Stage& stage) {
  Stage result = stage;
  result.models.clear();
  result.scene.objects.clear();
  for (SceneFile::Instance& instance : result.scene.instances) {
    result.models.push_back(stage.models[instance.object]);
    result.scene.objects.push_back(stage.scene.objects[instance.object]);
    instance.object = result.models.size() - 1;
  }
  return result;
}

}  // namespace shaolin
