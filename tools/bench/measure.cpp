#include "tools/bench/measure.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "tools/bench/timed_run.h"
#include "tools/cli/framing.h"
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

/// A wrong mesh, transform or scheme is wrong by far more than this: outlines by a few in a hundred pixels, depths by a
/// few thousandths of the scene. Coarse triangles are off by four times as much for each level less than three.
/// Of ambient occlusion nothing is asked: its rays start in the hollows between coarse triangles and the surface.
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
  const Workload& work = subject.work;
  const auto tracer = make_tracer(contender, subject.stage);
  const Answers primary = trace(work.primary, *tracer), shadow = trace(work.shadow, *tracer);
  const Answers random = trace(work.random, *tracer);
  result.ambient_errors = compare(subject.ambient, occlusions(work.ambient, *tracer));
  result.bytes = tracer->bytes();
  result.primary = count_levels(primary);
  result.shadow = count_levels(shadow);
  const HitFigures occluded = compare(occlusions_of(shadow), occlusions(work.shadow, *tracer));
  result.occluded_differs = occluded.lost + occluded.ghosts;

  std::vector<Ray> rays = work.primary;
  rays.insert(rays.end(), work.shadow.begin(), work.shadow.end());
  const auto joined = [](Answers first, const Answers& second) {
    first.insert(first.end(), second.begin(), second.end());
    return first;
  };
  result.errors =
      compare(contender, subject.exact, rays, joined(subject.primary, subject.shadow), joined(primary, shadow));
  result.random_errors = compare(contender, subject.exact, work.random, subject.random, random);
  result.fault = fault_of(contender, result.errors, subject.diagonal);
  if (result.fault.empty())
    if (const std::string fault = fault_of(contender, result.random_errors, subject.diagonal); !fault.empty())
      result.fault = "random rays: " + fault;
  return result;
}

/// Those that are timed, in their order, neighbours together that may be held at the same time.
std::vector<std::vector<Measurement*>> groups_of(std::vector<Measurement>& measurements, std::size_t most_bytes) {
  std::vector<std::vector<Measurement*>> groups;
  std::size_t held = 0;
  for (Measurement& one : measurements) {
    if (one.estimated || !one.fault.empty()) continue;
    held += one.bytes;
    if (groups.empty() || held > most_bytes) {
      groups.emplace_back();
      held = one.bytes;
    }
    groups.back().push_back(&one);
  }
  return groups;
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
  constexpr std::array names{"tessellation", "build", "cold", "camera", "shadow", "random", "ambient"};
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
      ambient(occlusions(work.ambient, exact)),
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
  const auto groups = groups_of(results, options.most_bytes);
  for (int run = 0; run < options.runs; ++run)
    for (const auto& group : groups) run_with_threads(1, [&] { time_run(subject, group); });
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
