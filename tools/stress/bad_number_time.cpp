#include <algorithm>
#include <limits>
#include <vector>

#include "schemes/errors.h"
#include "tools/bench/thread_stopwatch.h"
#include "tools/stress/aim.h"
#include "tools/stress/bad_numbers.h"
#include "tools/stress/meshes.h"

namespace shaolin::stress {

namespace {

double seconds_of(const RayQueries& queries, const std::vector<Ray>& rays) {
  constexpr int repetitions = 5;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < repetitions; ++i) {
    ThreadStopwatch stopwatch;
    for (const Ray& ray : rays) {
      try {
        queries.intersect(ray);
      } catch (const InputError&) {
        continue;
      }
    }
    least = std::min(least, stopwatch.lap());
  }
  return least;
}

}  // namespace

double bad_number_slowdown(const QueriesOf& queries_of) {
  constexpr int count = 2000;
  const Subject subject(sound_models().front(), queries_of);
  SampleRandom random(1);
  std::vector<Ray> sound, bad;
  for (int i = 0; i < count; ++i) {
    sound.push_back(probe_at(subject, aim_anywhere(subject, random), random.direction(), random).ray);
    bad.push_back(spoiled(sound.back(), random).ray);
  }
  seconds_of(subject.queries(), sound);  // what rays refine is there then
  return seconds_of(subject.queries(), bad) / seconds_of(subject.queries(), sound);
}

}  // namespace shaolin::stress
