#include "tools/bench/timed_run.h"

#include <algorithm>
#include <stdexcept>

#include "tools/bench/peak_memory.h"
#include "tools/bench/thread_stopwatch.h"
#include "tools/bench/turns.h"

namespace shaolin {
namespace {

/// What is asked in a warm phase.
struct Task {
  Phase phase;
  const std::vector<Ray>& rays;
  Query query;
};

std::array<Task, 4> tasks_of(const Workload& work) {
  return {{{Phase::camera, work.primary, Query::intersect},
           {Phase::shadow, work.shadow, Query::occluded},
           {Phase::random, work.random, Query::intersect},
           {Phase::ambient, work.ambient, Query::occluded}}};
}

void expect_hits(const Measurement& verified, Phase phase, std::size_t hits) {
  std::size_t expected = 0, slack = 0;
  if (phase == Phase::camera) expected = verified.primary.total();
  if (phase == Phase::shadow) {
    expected = verified.shadow.total();
    slack = verified.occluded_differs;
  }
  if (phase == Phase::random) expected = verified.random_errors.own_hits();
  if (phase == Phase::ambient) expected = verified.ambient_errors.own_hits();
  if (std::max(hits, expected) - std::min(hits, expected) > slack)
    throw std::runtime_error(verified.contender.name() + " answers otherwise when it is timed");
}

void add(Measurement& result, Phase phase, double seconds) {
  result.seconds[static_cast<std::size_t>(phase)].push_back(seconds);
}

/// All rays once, of which the first image is timed.
std::unique_ptr<Tracer> time_cold(const Subject& subject, Measurement& result) {
  const PeakMemory memory;
  ThreadStopwatch stopwatch;
  auto tracer = make_tracer(result.contender, subject.stage);
  const double made = stopwatch.lap(), tessellation = tracer->tessellation_seconds();
  if (result.contender.kind == ContenderKind::triangles) add(result, Phase::tessellation, tessellation);
  add(result, Phase::build, made - tessellation);
  double cold = made;
  for (const Task& task : tasks_of(subject.work)) {
    const Lap lap = trace_once(*tracer, task.rays, task.query);
    expect_hits(result, task.phase, lap.hits);
    if (task.phase == Phase::camera || task.phase == Phase::shadow) cold += lap.seconds;
  }
  add(result, Phase::cold, cold);
  result.peak_bytes = std::max(result.peak_bytes, memory.growth());
  return tracer;
}

}  // namespace

void time_run(const Subject& subject, std::span<Measurement* const> contenders) {
  std::vector<std::unique_ptr<Tracer>> scenes;
  std::vector<const Tracer*> tracers;
  for (Measurement* const one : contenders) {
    scenes.push_back(time_cold(subject, *one));
    tracers.push_back(scenes.back().get());
  }
  for (const Task& task : tasks_of(subject.work)) {
    if (task.rays.empty()) continue;
    const std::vector<Lap> laps = trace_in_turns(tracers, task.rays, task.query);
    for (std::size_t i = 0; i < laps.size(); ++i) {
      expect_hits(*contenders[i], task.phase, laps[i].hits);
      add(*contenders[i], task.phase, laps[i].seconds);
    }
  }
}

}  // namespace shaolin
