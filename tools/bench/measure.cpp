#include "tools/bench/measure.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_reduce.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "tools/cli/framing.h"
#include "tools/cli/render_stats.h"
#include "tools/cli/threads.h"

namespace shaolin {
namespace {

Scene build_copy(Stage stage) { return build_scene(stage); }

LevelCounts count_levels(const Answers& answers) {
  LevelCounts counts;
  for (const auto& answer : answers)
    if (answer) counts.add(answer->level);
  return counts;
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
std::string fault_of(const Contender& contender, const ErrorFigures& errors, double diagonal) {
  // Chords are as coarse as epsilon and the size of pixels ask for.
  const double coarse = contender.is_adaptive()                         ? 4
                        : contender.is_uniform() && contender.level < 3 ? std::pow(4.0, 3 - contender.level)
                                                                        : 1;
  if (static_cast<double>(errors.lost + errors.ghosts) > 0.03 * coarse * static_cast<double>(errors.hits) + 4)
    return std::to_string(errors.lost) + " lost and " + std::to_string(errors.ghosts) + " ghost hits of " +
           std::to_string(errors.hits);
  if (errors.distance.median > 2e-3 * coarse * diagonal)
    return "a median error of " + std::to_string(errors.distance.median) + " along the ray";
  return {};
}

Measurement answer(const Subject& subject, const Contender& contender) {
  Measurement result{.contender = contender};
  const auto tracer = make_tracer(contender, subject.stage);
  const Answers primary = trace(subject.work.primary, *tracer), shadow = trace(subject.work.shadow, *tracer);
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
  result.fault = fault_of(contender, result.errors, subject.diagonal);
  return result;
}

/// One run's times, appended. Throws std::runtime_error if the answers are not those that were verified.
void time_once(const Subject& subject, Measurement& result) {
  run_with_threads(1, [&] {
    Stopwatch stopwatch;
    const auto tracer = make_tracer(result.contender, subject.stage);
    for (std::vector<double>* const times : {&result.seconds, &result.again}) {
      std::size_t hits = 0, occluded = 0;
      for (const Ray& ray : subject.work.primary) hits += tracer->intersect(ray).has_value();
      for (const Ray& ray : subject.work.shadow) occluded += tracer->occluded(ray);
      times->push_back(stopwatch.lap());
      const std::size_t shadows = result.shadow.total();
      if (hits != result.primary.total() ||
          std::max(occluded, shadows) - std::min(occluded, shadows) > result.occluded_differs)
        throw std::runtime_error(result.contender.name() + " answers otherwise when it is timed");
    }
  });
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

Spread spread(std::vector<double> values) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return {(values[(n - 1) / 2] + values[n / 2]) / 2, values.front(), values.back()};
}

Spread ratio(const Measurement& a, const Measurement& b) {
  std::vector<double> ratios;
  for (std::size_t run = 0; run < std::min(a.seconds.size(), b.seconds.size()); ++run)
    ratios.push_back(a.seconds[run] / b.seconds[run]);
  return spread(ratios);
}

Subject::Subject(const ModelOptions& model, ImageSize size)
    : stage(load_stage(model)),
      exact(build_copy(stage)),
      view(choose_camera(stage, exact, size), size),
      work(make_workload(exact, view, stage.scene.look)),
      primary(trace(work.primary, exact)),
      shadow(trace(work.shadow, exact)),
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
      if (!result.estimated && result.fault.empty()) time_once(subject, result);
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
